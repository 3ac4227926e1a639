//! Named parameters that show the state of the interpreter (LinuxCNC "Predefined Named Parameters").

macro_rules! predefined {
    ($($name:ident $text:literal $what:literal;)*) => {
        /// A read-only named parameter.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum Predefined { $(#[doc = $what] $name,)* }

        impl Predefined {
            /// The parameter with this name in lower case.
            pub fn named(text: &str) -> Option<Self> {
                match text { $($text => Some(Predefined::$name),)* _ => None }
            }
        }
    };
}

predefined! {
    VersionMajor "_vmajor" "Version of the language: 2.9.";
    VersionMinor "_vminor" "Its minor part: 0.";
    Line "_line" "Source line.";
    MotionMode "_motion_mode" "Motion code in tenths, -1 for none.";
    Plane "_plane" "170, 180, 190.";
    Compensation "_ccomp" "400, 410, 420, 411, 421.";
    Metric "_metric" "1 in G21.";
    Imperial "_imperial" "1 in G20.";
    Absolute "_absolute" "1 in G90.";
    Incremental "_incremental" "1 in G91.";
    InverseTime "_inverse_time" "1 in G93.";
    UnitsPerMinute "_units_per_minute" "1 in G94.";
    UnitsPerRev "_units_per_rev" "1 in G95.";
    CoordSystem "_coord_system" "540 .. 593.";
    ToolOffset "_tool_offset" "1 in G43.";
    RetractR "_retract_r_plane" "1 in G99.";
    RetractOld "_retract_old_z" "1 in G98.";
    SpindleRpm "_spindle_rpm_mode" "1 in G97.";
    SpindleCss "_spindle_css_mode" "1 in G96.";
    ArcAbsolute "_ijk_absolute_mode" "1 in G90.1.";
    Diameter "_lathe_diameter_mode" "1 in G7.";
    Radius "_lathe_radius_mode" "1 in G8.";
    SpindleOn "_spindle_on" "1 if the spindle turns.";
    SpindleCw "_spindle_cw" "1 if it turns clockwise.";
    Mist "_mist" "1 if mist is on.";
    Flood "_flood" "1 if flood is on.";
    SpeedOverride "_speed_override" "1 if the switch counts.";
    FeedOverride "_feed_override" "1 if the switch counts.";
    AdaptiveFeed "_adaptive_feed" "1 after M52.";
    FeedHold "_feed_hold" "1 after M53.";
    Feed "_feed" "F.";
    Rpm "_rpm" "S.";
    X "_x" "Program coordinate.";
    Y "_y" "Program coordinate.";
    Z "_z" "Program coordinate.";
    A "_a" "Program coordinate.";
    B "_b" "Program coordinate.";
    C "_c" "Program coordinate.";
    U "_u" "Program coordinate.";
    V "_v" "Program coordinate.";
    W "_w" "Program coordinate.";
    AbsoluteX "_abs_x" "Machine coordinate.";
    AbsoluteY "_abs_y" "Machine coordinate.";
    AbsoluteZ "_abs_z" "Machine coordinate.";
    AbsoluteA "_abs_a" "Machine coordinate.";
    AbsoluteB "_abs_b" "Machine coordinate.";
    AbsoluteC "_abs_c" "Machine coordinate.";
    CurrentTool "_current_tool" "Tool in the spindle.";
    CurrentPocket "_current_pocket" "Its pocket.";
    SelectedTool "_selected_tool" "Tool of the last T word.";
    SelectedPocket "_selected_pocket" "Its pocket.";
    Value "_value" "Value of the last return.";
    ValueReturned "_value_returned" "1 if the last subroutine returned a value.";
    Task "_task" "0: not under a task.";
    CallLevel "_call_level" "Calls in progress.";
    RemapLevel "_remap_level" "0.";
}
