//! Words with a meaning of their own. The lexer marks them, the parser decides by position whether they are meant.
//! From: IEC 61131-3 §6.1.2 (language reference §1.3).

macro_rules! keywords {
    ($($class:ident { $($name:ident $text:literal)* })*) => {
        /// A marked word; `None` for plain names.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        #[repr(u8)]
        pub(crate) enum Kw { None, $($($name,)*)* }

        const WORDS: &[(&str, Kw)] = &[$($(($text, Kw::$name),)*)*];

        impl Kw {
            /// Every marked word, in any case.
            fn class(self) -> Class {
                match self { Kw::None => Class::Free, $($(Kw::$name => Class::$class,)*)* }
            }
        }
    };
}

/// What a marked word can be used for besides its own meaning.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Class {
    /// Opens a declaration; the parser takes up its work here after a mistake.
    Declaration,
    /// Opens a variable section.
    Section,
    /// Opens a statement.
    Statement,
    /// Separates or ends the parts of a statement.
    Part,
    /// Closes a statement.
    EndStatement,
    /// Closes a declaration.
    EndDeclaration,
    /// Reserved, without a place in recovery.
    Reserved,
    /// A type name of the standard.
    Type,
    /// Meant in one place only; a name everywhere else.
    Free,
}

keywords! {
    Declaration {
        Function "FUNCTION" FunctionBlock "FUNCTION_BLOCK" Program "PROGRAM" Type "TYPE" Configuration "CONFIGURATION"
        Class "CLASS" Interface "INTERFACE" Namespace "NAMESPACE" Resource "RESOURCE"
    }
    Section {
        Var "VAR" VarInput "VAR_INPUT" VarOutput "VAR_OUTPUT" VarInOut "VAR_IN_OUT" VarTemp "VAR_TEMP" VarExternal "VAR_EXTERNAL"
        VarGlobal "VAR_GLOBAL" VarAccess "VAR_ACCESS" VarConfig "VAR_CONFIG"
    }
    Statement {
        If "IF" Case "CASE" For "FOR" While "WHILE" Repeat "REPEAT" Exit "EXIT" Continue "CONTINUE" Return "RETURN"
    }
    Part { Else "ELSE" Elsif "ELSIF" Until "UNTIL" }
    EndStatement { EndIf "END_IF" EndCase "END_CASE" EndFor "END_FOR" EndWhile "END_WHILE" EndRepeat "END_REPEAT" }
    EndDeclaration {
        EndFunction "END_FUNCTION" EndFunctionBlock "END_FUNCTION_BLOCK" EndProgram "END_PROGRAM" EndType "END_TYPE"
        EndConfiguration "END_CONFIGURATION" EndClass "END_CLASS" EndInterface "END_INTERFACE" EndNamespace "END_NAMESPACE"
        EndResource "END_RESOURCE" EndVar "END_VAR" EndStruct "END_STRUCT" EndMethod "END_METHOD" EndAction "END_ACTION"
        EndProperty "END_PROPERTY" EndGet "END_GET" EndSet "END_SET" EndStep "END_STEP" EndTransition "END_TRANSITION"
    }
    Reserved {
        Abstract "ABSTRACT" Action "ACTION" And "AND" Array "ARRAY" At "AT" By "BY" Constant "CONSTANT" Do "DO" Extends "EXTENDS"
        FEdge "F_EDGE" False "FALSE" Final "FINAL" From "FROM" Implements "IMPLEMENTS" InitialStep "INITIAL_STEP"
        Internal "INTERNAL" Method "METHOD" Mod "MOD" NonRetain "NON_RETAIN" Not "NOT" Null "NULL" Of "OF" On "ON" Or "OR"
        Overlap "OVERLAP" Override "OVERRIDE" Private "PRIVATE" Protected "PROTECTED" Public "PUBLIC" REdge "R_EDGE"
        ReadOnly "READ_ONLY" ReadWrite "READ_WRITE" Ref "REF" RefTo "REF_TO" Retain "RETAIN" Step "STEP" Struct "STRUCT"
        Super "SUPER" Task "TASK" Then "THEN" This "THIS" To "TO" Transition "TRANSITION" True "TRUE" Using "USING" With "WITH"
        Xor "XOR"
    }
    Type {
        Bool "BOOL" Sint "SINT" Int "INT" Dint "DINT" Lint "LINT" Usint "USINT" Uint "UINT" Udint "UDINT" Ulint "ULINT"
        Real "REAL" Lreal "LREAL" Time "TIME" Ltime "LTIME" Date "DATE" Ldate "LDATE" Tod "TOD" TimeOfDay "TIME_OF_DAY"
        Ltod "LTOD" LtimeOfDay "LTIME_OF_DAY" Dt "DT" DateAndTime "DATE_AND_TIME" Ldt "LDT" LdateAndTime "LDATE_AND_TIME"
        Byte "BYTE" Word "WORD" Dword "DWORD" Lword "LWORD" Char "CHAR" Wchar "WCHAR" String "STRING" Wstring "WSTRING"
        Any "ANY" AnyDerived "ANY_DERIVED" AnyElementary "ANY_ELEMENTARY" AnyMagnitude "ANY_MAGNITUDE" AnyNum "ANY_NUM"
        AnyReal "ANY_REAL" AnyInt "ANY_INT" AnyUnsigned "ANY_UNSIGNED" AnySigned "ANY_SIGNED" AnyDuration "ANY_DURATION"
        AnyBit "ANY_BIT" AnyChars "ANY_CHARS" AnyString "ANY_STRING" AnyChar "ANY_CHAR" AnyDate "ANY_DATE"
    }
    Free {
        AndThen "AND_THEN" OrElse "OR_ELSE" Union "UNION" EndUnion "END_UNION" Pointer "POINTER" Reference "REFERENCE"
        Persistent "PERSISTENT" VarStat "VAR_STAT" VarInst "VAR_INST" Property "PROPERTY" PropertyGet "PROPERTY_GET"
        PropertySet "PROPERTY_SET"
        Actions "ACTIONS" EndActions "END_ACTIONS" Jmp "JMP" Void "VOID"
        // Misspellings that are common enough to be understood.
        Elseif "ELSEIF" Elif "ELIF" Endif "ENDIF" Endfor "ENDFOR" Endwhile "ENDWHILE" Endcase "ENDCASE" Endrepeat "ENDREPEAT"
        Functionblock "FUNCTIONBLOCK"
    }
}

impl Kw {
    /// As the standard writes it; empty for plain names.
    pub(crate) fn text(self) -> &'static str {
        WORDS.get((self as usize).wrapping_sub(1)).map_or("", |w| w.0)
    }
    /// True for a word of edition 3 that older dialects do not know: a plain name there (§1.3).
    pub(crate) fn is_new(self) -> bool {
        use Kw::*;
        let objects = matches!(
            self,
            Class
                | EndClass
                | Interface
                | EndInterface
                | Namespace
                | EndNamespace
                | Method
                | EndMethod
                | Using
                | Extends
                | Implements
                | Abstract
                | Final
                | Override
                | Internal
                | Private
                | Protected
                | Public
                | This
                | Super
        );
        let types = self.is_new_type() || matches!(self, LtimeOfDay | LdateAndTime | Ltime);
        objects || types || matches!(self, Null | Ref | RefTo | Overlap | Continue)
    }
    /// True for a reserved word that the vendors also take as a name, where it can mean nothing else.
    pub(crate) fn is_name_elsewhere(self) -> bool {
        use Kw::*;
        matches!(self, Action | Step | InitialStep | Transition | On | From | REdge | FEdge | Task | With | ReadOnly | ReadWrite)
    }
    /// Types that came with edition 3, whose names CODESYS programs use for their own members.
    pub(crate) fn is_new_type(self) -> bool {
        matches!(self, Kw::Ldate | Kw::Ltod | Kw::Ldt | Kw::Char | Kw::Wchar)
    }
    /// True if it can't be a name in profile `std`.
    pub(crate) fn is_reserved(self) -> bool {
        self.class() != Class::Free
    }
    pub(crate) fn is_type(self) -> bool {
        self.class() == Class::Type
    }
    pub(crate) fn is_section(self) -> bool {
        self.class() == Class::Section
    }
    pub(crate) fn opens_declaration(self) -> bool {
        self.class() == Class::Declaration
    }
    pub(crate) fn opens_statement(self) -> bool {
        self.class() == Class::Statement
    }
    pub(crate) fn ends_statement(self) -> bool {
        self.class() == Class::EndStatement
    }
    pub(crate) fn ends_declaration(self) -> bool {
        self.class() == Class::EndDeclaration
    }
    /// True if a list of statements can't go on here.
    pub(crate) fn ends_statements(self) -> bool {
        use Class::*;
        matches!(self.class(), Declaration | Section | Part | EndStatement | EndDeclaration)
    }
    /// What a common misspelling stands for.
    pub(crate) fn meant(self) -> Option<Kw> {
        Some(match self {
            Kw::Elseif | Kw::Elif => Kw::Elsif,
            Kw::Endif => Kw::EndIf,
            Kw::Endfor => Kw::EndFor,
            Kw::Endwhile => Kw::EndWhile,
            Kw::Endcase => Kw::EndCase,
            Kw::Endrepeat => Kw::EndRepeat,
            _ => return None,
        })
    }
    /// The mark of a word.
    pub(crate) fn of(word: &str) -> Kw {
        let bytes = word.as_bytes();
        if bytes.len() < 2 || bytes.len() > LONGEST {
            return Kw::None;
        }
        let mut slot = hash(bytes);
        loop {
            match WORDS.get((SLOTS[slot] as usize).wrapping_sub(1)) {
                None => return Kw::None,
                Some((text, kw)) if text.as_bytes().eq_ignore_ascii_case(bytes) => return *kw,
                Some(_) => slot = (slot + 1) % SLOTS.len(),
            }
        }
    }
}

const LONGEST: usize = 18;

/// Open addressing, built at compile time: 0 is empty, else one more than the position in [`WORDS`].
static SLOTS: [u8; 512] = slots();

const fn slots() -> [u8; 512] {
    assert!(WORDS.len() < 255);
    let mut table = [0u8; 512];
    let mut i = 0;
    while i < WORDS.len() {
        let bytes = WORDS[i].0.as_bytes();
        assert!(bytes.len() <= LONGEST);
        let mut slot = hash(bytes);
        while table[slot] != 0 {
            slot = (slot + 1) % 512;
        }
        table[slot] = i as u8 + 1;
        i += 1;
    }
    table
}

/// The same for both cases of a letter.
const fn hash(bytes: &[u8]) -> usize {
    let mut h = bytes.len() as u32;
    let mut i = 0;
    while i < bytes.len() {
        h = h.wrapping_mul(31).wrapping_add((bytes[i] & 0xDF) as u32);
        i += 1;
    }
    (h.wrapping_mul(0x9E37_79B1) >> 23) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_found_in_any_case_and_nothing_else_is() {
        for (text, kw) in WORDS {
            assert_eq!(Kw::of(text), *kw);
            assert_eq!(Kw::of(&text.to_lowercase()), *kw);
            assert_eq!(kw.text(), *text);
            assert_eq!(Kw::of(&format!("{text}x")), Kw::None);
        }
        for name in ["", "x", "IN", "EN", "ENO", "PRIORITY", "LD", "END_FUNCTION_BLOCKS", "äö"] {
            assert_eq!(Kw::of(name), Kw::None, "{name}");
        }
    }
}
