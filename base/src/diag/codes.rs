//! Every diagnostic and fault code, once. A code is for ever: never reused, never renumbered.
//!
//! P0 text, P1 names, P2 types, P3 program rules, P4 tasks and configuration, P5 Instruction List, P6 advice (allowed, and most
//! likely a mistake: always a warning); N g-code; C project and image files; T tests; F runtime faults, whose number is the ErrorID word
//! of a function block in hexadecimal. Each has a page in `docs/codes/`, which `takt explain` prints.

use super::Severity;

macro_rules! codes {
    ($($(#[$meta:meta])* $text:ident $name:ident $title:literal $($severity:ident)?;)*) => {
        /// A rule or fault with a name, a number and a page.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
        pub enum Code { $($(#[$meta])* #[doc = $title] $name,)* }

        impl Code {
            /// All codes.
            pub const ALL: &'static [Code] = &[$(Code::$name,)*];
            /// The number, such as `P2007`.
            pub const fn text(self) -> &'static str {
                match self { $(Code::$name => stringify!($text),)* }
            }
            /// One line that says the rule.
            pub const fn title(self) -> &'static str {
                match self { $(Code::$name => $title,)* }
            }
            /// What it is unless the reporter says otherwise.
            pub const fn severity(self) -> Severity {
                match self { $(Code::$name => codes!(@severity $($severity)?),)* }
            }
            /// The page in `docs/codes/`, in Markdown.
            pub const fn page(self) -> &'static str {
                match self {
                    $(Code::$name => include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/codes/", stringify!($text), ".md")),)*
                }
            }
        }
    };
    (@severity) => { Severity::Error };
    (@severity $severity:ident) => { Severity::$severity };
}

codes! {
    // --- P0 text ---
    P0001 UnexpectedCharacter "this character can't start anything here";
    P0002 UnterminatedComment "a comment is not closed";
    P0003 UnterminatedString "a string is not closed on its line";
    P0004 BadEscape "this `$` escape does not exist";
    P0005 BadNumber "this number is not written as the standard asks";
    P0006 BadTypedLiteral "this literal does not fit its type prefix";
    P0007 BadTime "this duration or date is not well formed";
    P0008 BadAddress "this direct address is not well formed";
    P0009 BadIdentifier "an identifier may not have two underscores in a row or one at its end";
    P0010 Expected "the parser needs something else here";
    P0011 NestedTooDeep "nesting is too deep";
    P0012 NotSupportedYet "this part of the language is not supported by this version";
    P0013 TooMuch "the parser stops here";
    P0014 VendorForm "this form belongs to another language profile";

    // --- P1 names ---
    P1001 DuplicateName "this name is declared twice in one scope";
    P1002 KeywordAsName "a keyword can't be a name";
    P1003 UnknownName "name is not declared in this scope";
    P1004 UnknownType "no type, function block or class has this name";
    P1005 UnknownMember "this type has no such member";
    P1006 UnknownParameter "the called unit has no such parameter";
    P1007 AmbiguousEnumerator "several enumerations have a value of this name";
    P1008 GlobalWithoutExternal "a global is used without a VAR_EXTERNAL declaration" Warning;
    P1009 ExternalMismatch "VAR_EXTERNAL does not match a global variable";
    P1040 AmbiguousName "this name is found in more than one place";
    P1041 UnknownNamespace "no namespace has this name";
    P1042 InternalNamespace "this namespace is INTERNAL";
    P1043 QualifiedOnly "this global needs the name of its list or namespace";
    P1020 AccessDenied "this member can't be used from here";
    P1021 MemberClash "a method and a variable have the same name";
    P1022 HidesInherited "this variable has the name of an inherited one";
    P1023 UnknownMethod "this type has no such method";
    P1024 NoThis "THIS and SUPER need a type around them";
    P1025 NoBase "SUPER needs a base type";

    // --- P2 types ---
    P2001 TypeMismatch "the types do not fit";
    P2002 NoCommonType "the operands have no common type";
    P2003 BadOperand "the operator is not defined for this type";
    P2004 OutOfRange "this constant does not fit the type";
    P2005 NotConstant "a constant is needed here";
    P2006 NotBool "a condition must be BOOL";
    P2007 Narrowing "a narrower type needs an explicit conversion";
    P2008 NotAnArray "only an array can be indexed";
    P2009 IndexOutOfRange "this index is outside of the array";
    P2010 BadInitializer "this initial value does not fit the type";
    P2011 DivisionByZeroConstant "division by the constant zero";
    P2012 NotCallable "this can't be called";
    P2013 WrongArgumentCount "the number of arguments does not fit";
    P2014 NotAVariable "a variable is needed here";
    P2015 RecursiveType "a type can't contain itself";
    P2016 TypeTooLarge "this type or program needs more memory than there is";
    P2017 NotReferable "this has no place that a reference may keep";
    P2020 BadLayout "a member has no place in this structure";
    P2019 MisplacedOpenArray "an array of variable length is a parameter, used by its elements";
    P2018 NotAReference "only a reference can be dereferenced";
    P2030 NotABase "this can't be extended or implemented here";
    P2031 InheritanceCycle "a type can't inherit from itself";
    P2032 AbstractInstance "an abstract type has no instances";
    P2033 NotImplementedBy "the type does not implement the interface";

    // --- P3 program rules ---
    P3001 AssignToConstant "a constant can't be assigned";
    P3002 AssignToInput "an input can't be assigned inside its own unit";
    P3003 ExitOutsideLoop "EXIT and CONTINUE belong in a loop";
    P3004 DuplicateCaseLabel "two CASE labels cover the same value";
    P3005 ForVariable "the FOR control variable is not usable here";
    P3006 ForStepZero "a FOR step of zero never ends";
    P3007 MissingInOut "a VAR_IN_OUT must be given at every call";
    P3008 SectionNotAllowed "this variable section is not allowed here";
    P3009 Recursion "this unit calls itself" Warning;
    P3010 AssignToOutput "an output of a function block can't be assigned from outside";
    P3011 AddressMismatch "the type does not fit the direct address";
    P3012 ResultNeverAssigned "the function never assigns its result" Warning;
    P3013 WriteToInputImage "the input image can't be written";
    P3014 RetainNotKept "retained values are not kept over a restart by this version" Warning;
    P3015 ReferenceKept "a reference can't be retained or located";
    P3016 ConstantWithoutValue "a constant needs a value";
    P3040 MissingMethod "a method that the type promises is missing";
    P3041 SignatureMismatch "the method differs from the one that it replaces";
    P3042 MissingOverride "a method that replaces an inherited one needs OVERRIDE";
    P3043 OverridesFinal "what is FINAL can't be replaced or extended";
    P3044 NothingToOverride "OVERRIDE without an inherited method";
    P3045 AbstractMethod "an ABSTRACT method can't be used like this";
    P3046 PropertySide "the property lacks GET or SET";
    P3047 NotBound "nothing is ever assigned to this interface variable" Warning;
    P3080 AddressLeftOpen "no VAR_CONFIG gives this variable its address";
    P3081 UnknownInstance "no instance has this path";
    P3082 NotConfigurable "this can't be given by VAR_CONFIG";
    P3083 InstanceMismatch "the variable at this path is declared differently";
    P3084 AccessDirection "what this access path names can't be written";

    // --- P4 tasks and configuration ---
    P4001 UnknownTask "no task has this name";
    P4002 NoProgram "nothing to run: the project has no PROGRAM";
    P4003 BadTask "this task can't be scheduled";
    P4004 BadBinding "this can't have a task of its own";

    // --- P5 Instruction List ---
    P5001 UnknownInstruction "no instruction or function has this name";
    P5002 InstructionOperand "the operand of the instruction is missing or one too many";
    P5003 ResultUndefined "there is no current result here";
    P5004 ResultDiffers "the current results of the ways to this label differ in type";
    P5005 UnknownLabel "no label of this name can be reached from here";
    P5006 DuplicateLabel "this label stands twice in one body";
    P5007 NotInParentheses "this instruction can't stand inside of parentheses";
    P5008 NoInputOperator "the instance has no such input operator";

    // --- P6 advice ---
    P6001 Unreachable "this statement is never reached" Warning;
    P6002 NotYetAssigned "this variable is read before anything is assigned to it" Warning;
    P6003 Unused "this variable is never used" Warning;
    P6004 NeverRead "this variable is assigned and never read" Warning;
    P6005 UnusedMethod "this private method is never called" Warning;
    P6006 HidesOuter "this variable hides something of the same name" Warning;
    P6007 RealEquality "reals are seldom exactly equal" Warning;
    P6008 OneOutcome "this condition has only one outcome" Warning;
    P6009 ShiftTooFar "this shift leaves nothing" Warning;
    P6010 SuccessIgnored "nobody looks at whether this call succeeded" Warning;
    P6011 TwoWriters "two programs write this output" Warning;
    P6012 Overwritten "this value is overwritten before anybody sees it" Warning;
    P6013 SelfAssignment "a variable is assigned to itself" Warning;

    // --- N g-code ---
    N0001 BadCharacter "this character is not part of a g-code block";
    N0002 BadWord "this word is not well formed";
    N0003 UnknownCode "this G or M code is not supported";
    N0004 ModalConflict "two codes of one modal group in one block";
    N0005 DuplicateWord "the same word stands twice in a block";
    N0006 MissingWord "the block lacks a word that its code needs";
    N0007 RadiusMismatch "start and end of the arc are not on one circle";
    N0008 NoFeed "a feed move without a feed rate";
    N0009 UnusedWord "no code in the block uses this word";
    N0010 BadValue "this value is not allowed for the word";
    N0011 CommentNotClosed "a comment is not closed";
    N0012 OutsideLimits "the move leaves the travel of an axis";
    N0013 NotOnGrid "the position is not a whole number of basic length units";
    N0014 NotInThisVersion "this part of the g-code language is not supported by this version";
    N0015 UnstableArc "a small change of this radius or end point moves the arc far" Warning;
    N0016 BadExpression "this expression is not well formed";
    N0017 BadParameter "this parameter can't be used here";
    N0018 CalculationFault "the calculation has no result";
    N0019 BadFlow "this O word does not fit here";
    N0020 MissingSub "the subroutine is not found";
    N0021 NestedTooDeeply "too many subroutines call each other";
    N0022 EndlessProgram "the program runs in a circle and does nothing";
    N0023 UnknownTool "the tool is not in the tool table";
    N0024 BadTable "this row of a table can't be read";
    N0025 CompensationFault "the tool can't follow the contour with cutter compensation";
    N0026 SpindleStopped "the code needs a turning spindle";
    N0027 NotInThisMode "the code is not allowed in the mode that is in force";
    N0028 ProgramAborted "the program stops itself";
    N0040 FileChanged "the part program has changed while it runs";
    N0041 FileUnreadable "the part program can't be read any further";
    N0042 RowTooLong "the row is too long for a part program";
    N0043 ProgramTooLarge "the part program needs more memory than it may have";
    N0044 NoSuchLine "the part program has no such line";
    N0050 BadMacro "this macro statement does not fit here";
    N0051 MissingBlock "no block has this number";
    N0052 NotOfThisControl "the code belongs to other controls";
    N0053 BadVariable "this variable can't be used here";
    N0054 MacroAlarm "the macro program raises an alarm";
    N0055 BadCorner "this corner can't be chamfered or rounded";
    N0056 BadContour "this contour can't be cut in passes";
    N0057 LeftOut "the lenient switch passes over this" Warning;
    N0058 BadVirtualMove "polar or cylindrical interpolation can't make this move";
    N0070 UnknownPlcVariable "the PLC program has no such variable";
    N0071 PlcVariableType "a part program can't use this PLC variable";
    N0072 PlcValue "the PLC variable can't take this value";
    N0073 TooManyReads "the row reads too many PLC variables";
    N0074 NoSuchInput "the channel has no input or output of this number";
    N0075 ProbeMissed "the probe did not trip";
    N0076 ProbeNotReady "the probe is not in the state that the probing needs";
    N0077 ThreadTooFast "the axes can't follow the spindle";
    N0078 NoStartLine "the program does not come to the line where it shall start";

    // --- C project and image files ---
    C0001 BadProjectFile "the project file can't be used";
    C0002 UnknownKey "the project file has no such key";
    C0003 BadImage "this is not an image that this version can run";
    C0004 MissingNative "the image needs a function that this controller does not have";
    C0005 FileError "a file can't be read or written";
    C0006 BadStimulus "the stimulus file is not well formed";
    C0007 UnknownPath "no variable has this path";
    C0008 BadValueText "this text is not a value of the variable's type";
    C0009 ReadOnlyPath "this access path can be read alone";

    // --- T tests ---
    T0001 BadTestPragma "this `{test}` pragma is not understood";
    T0002 TestInConfiguration "a task can't run a unit test";

    // --- F runtime faults and ErrorID numbers ---
    F0001 ParameterOutOfRange "a parameter is out of range";
    F0002 UnknownReference "the axis or channel reference is not one of this controller";
    F0003 LimitExceeded "the target is outside of the software limits";
    F0006 RetainDamaged "the file of retained values is damaged" Warning;
    F0007 RetainChanged "a retained variable has changed its type" Warning;
    F0008 RetainFile "the retained values can't be stored" Warning;
    F0100 NotPowered "the axis is not powered";
    F0101 WrongState "the command is not allowed in this state";
    F0102 NotHomed "the axis is not homed";
    F0103 AxisGrouped "the axis belongs to a running channel";
    F0104 DirectionBlocked "motion in this direction is not enabled";
    F0200 FollowingError "the following error is too large";
    F0201 DriveFault "the drive reports a fault";
    F0400 QueueFull "too many commands are waiting";
    F0500 UnsupportedOption "this option of the block is not supported by this version";
    F0600 ProgramNotLoaded "no part program is loaded";
    F0601 ProgramError "the part program has an error";
    F0602 ProgramFile "the part program file can't be read";
    F0603 AuxTimeout "an auxiliary function was not finished in time";
    F0604 AuxFault "the PLC program reported a fault of an auxiliary function";
    F0605 ChannelState "the command is not allowed in this state of the channel";
    F0625 KeptFile "the parameters or the tool table of a channel can't be stored" Warning;
    F0626 TableFile "the parameters or the tool table of a channel can't be read";
    F0701 DivisionByZero "integer division by zero";
    F0702 IndexFault "array index out of bounds";
    F0703 RangeFault "value outside of the subrange";
    F0704 StackOverflow "the calls are nested too deep";
    F0705 Watchdog "the task did not end in time";
    F0706 BadReference "a reference does not point to anything";
    F0707 StringIndexFault "string position out of bounds";
    F0708 NativePanic "a library function failed inside";
    F0709 MemoryFault "the program touched memory that is not its own";
    F0710 ForStepFault "a FOR step of zero";
    F0711 NullReference "a NULL reference was used";
    F0712 WildPointer "a pointer does not point to a variable";
}

impl Code {
    /// The code with this number, if there is one. Case does not matter.
    pub fn from_text(text: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|c| c.text().eq_ignore_ascii_case(text))
    }
    /// True for the P6 codes: what is allowed and most likely a mistake.
    pub fn is_advice(self) -> bool {
        self.text().starts_with("P6")
    }
    /// The number of an F code as an ErrorID word (`F0701` is 16#0701); 0 for all others.
    pub fn error_id(self) -> u16 {
        self.text().strip_prefix('F').and_then(|n| u16::from_str_radix(n, 16).ok()).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn numbers_are_unique_and_pages_name_their_code() {
        let numbers: HashSet<_> = Code::ALL.iter().map(|c| c.text()).collect();
        assert_eq!(numbers.len(), Code::ALL.len());
        for code in Code::ALL {
            assert!(code.page().starts_with(&format!("# {}: ", code.text())), "docs/codes/{}.md has no heading", code.text());
        }
    }

    #[test]
    fn faults_are_error_ids() {
        assert_eq!(Code::DivisionByZero.error_id(), 0x0701);
        assert_eq!(Code::Narrowing.error_id(), 0);
        assert_eq!(Code::from_text("f0701"), Some(Code::DivisionByZero));
    }
}
