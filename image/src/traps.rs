//! Why a program was stopped, and where. The code generator, the interpreter and natives raise them; the runtime records them.

use takt_base::Code;

macro_rules! traps {
    ($($name:ident = $number:literal $code:ident;)*) => {
        /// A run-time fault. The number is the trap code in the machine code.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
        pub enum Trap { $(#[doc = concat!("See `Code::", stringify!($code), "`.")] $name = $number,)* }

        impl Trap {
            /// All traps.
            pub const ALL: &'static [Trap] = &[$(Trap::$name,)*];
            /// From the number in the machine code.
            pub const fn from_number(n: u8) -> Option<Trap> {
                match n { $($number => Some(Trap::$name),)* _ => None }
            }
            /// The diagnostic code.
            pub const fn code(self) -> Code {
                match self { $(Trap::$name => Code::$code,)* }
            }
            /// Name in MIR text.
            pub const fn name(self) -> &'static str {
                match self { $(Trap::$name => stringify!($name),)* }
            }
        }
    };
}

traps! {
    DivisionByZero = 1 DivisionByZero;
    Index = 2 IndexFault;
    Range = 3 RangeFault;
    StackOverflow = 4 StackOverflow;
    Watchdog = 5 Watchdog;
    Reference = 6 BadReference;
    StringIndex = 7 StringIndexFault;
    NativePanic = 8 NativePanic;
    Memory = 9 MemoryFault;
    ForStep = 10 ForStepFault;
    NullReference = 11 NullReference;
    WildPointer = 12 WildPointer;
}

/// A trap with its place. Small and `Copy`: it is made on the cyclic side. `image.files`, `image.functions` give the names.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fault {
    /// Why.
    pub trap: Trap,
    /// Index into `Image::functions`; `u32::MAX` if unknown.
    pub function: u32,
    /// Index into `Image::files`; `u32::MAX` if unknown.
    pub file: u32,
    /// Line from 1; 0 if unknown.
    pub line: u32,
}
