//! What a scene file says, before anybody has asked what it means.

use std::borrow::Cow;
use std::ops::Range;
use std::path::PathBuf;

/// Bytes of the source, counted from 0.
pub type Span = Range<usize>;

/// One directive and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Directive<'a> {
    /// From the keyword to the end of the last argument.
    pub span: Span,
    /// The keyword alone.
    pub keyword: Span,
    /// The place of the keyword among [`KEYWORDS`](super::KEYWORDS), if it is one of them.
    pub keyword_number: Option<usize>,
    /// What it says.
    pub statement: Statement<'a>,
}

/// A directive with its arguments; numbers are as in the file, degrees and row order included.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement<'a> {
    /// `Identity`
    Identity,
    /// `Translate x y z`
    Translate([f64; 3]),
    /// `Scale x y z`
    Scale([f64; 3]),
    /// `Rotate degrees x y z`
    Rotate([f64; 4]),
    /// `LookAt`: the eye, a point to look at, the up vector.
    LookAt([f64; 9]),
    /// `Transform m00 .. m33`: the matrix replaces the current one.
    Transform([f64; 16]),
    /// `ConcatTransform m00 .. m33`
    ConcatTransform([f64; 16]),
    /// `CoordinateSystem "name"`
    CoordinateSystem(Text<'a>),
    /// `CoordSysTransform "name"`
    CoordSysTransform(Text<'a>),
    /// `TransformTimes start end`
    TransformTimes([f64; 2]),
    /// `ActiveTransform StartTime | EndTime | All`
    ActiveTransform(ActiveTransform),
    /// `ReverseOrientation`
    ReverseOrientation,
    /// `AttributeBegin`
    AttributeBegin,
    /// `AttributeEnd`
    AttributeEnd,
    /// `Attribute "target" parameters`: defaults for what follows; the entity's name is the target.
    Attribute(Entity<'a>),
    /// `TransformBegin`
    TransformBegin,
    /// `TransformEnd`
    TransformEnd,
    /// `WorldBegin`
    WorldBegin,
    /// `WorldEnd`
    WorldEnd,
    /// `Include "file"`: the file is read in place of the directive.
    Include(Text<'a>),
    /// `Import "file"`: the file is read by itself, with a copy of the graphics state.
    Import(Text<'a>),
    /// `Camera "type" parameters`
    Camera(Entity<'a>),
    /// `Film "type" parameters`
    Film(Entity<'a>),
    /// `Accelerator "type" parameters`
    Accelerator(Entity<'a>),
    /// `Shape "type" parameters`
    Shape(Entity<'a>),
    /// `ObjectBegin "name"`
    ObjectBegin(Text<'a>),
    /// `ObjectEnd`
    ObjectEnd,
    /// `ObjectInstance "name"`
    ObjectInstance(Text<'a>),
    /// `Material "type" parameters`: only the type is kept.
    Material(Text<'a>),
    /// `MakeNamedMaterial "name" parameters`
    MakeNamedMaterial(Entity<'a>),
    /// `NamedMaterial "name"`
    NamedMaterial(Text<'a>),
    /// A directive without influence on hit and depth, by its keyword.
    Ignored(&'static str),
    /// A directive that no pbrt knows, by its keyword.
    Private(&'a str),
}

/// Which of the two transforms of a moving scene the directives that follow change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActiveTransform {
    /// That of the start time.
    StartTime,
    /// That of the end time.
    EndTime,
    /// Both.
    All,
}

/// A quoted string.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text<'a> {
    /// What is between the quotes, escapes undone; bytes that are not UTF-8 are replaced.
    pub text: Cow<'a, str>,
    /// The string with its quotes.
    pub span: Span,
    /// The bytes between the quotes, escapes undone, where they are not UTF-8.
    pub raw: Option<Box<[u8]>>,
}

impl<'a> Text<'a> {
    /// The string that `bytes` are, escapes undone, at `span`.
    pub(in crate::scene) fn new(bytes: Cow<'a, [u8]>, span: Span) -> Text<'a> {
        let (text, raw) = match bytes {
            Cow::Borrowed(bytes) => match std::str::from_utf8(bytes) {
                Ok(text) => (Cow::Borrowed(text), None),
                Err(_) => (String::from_utf8_lossy(bytes), Some(bytes.into())),
            },
            Cow::Owned(bytes) => match String::from_utf8(bytes) {
                Ok(text) => (Cow::Owned(text), None),
                Err(error) => {
                    let bytes = error.into_bytes();
                    (
                        Cow::Owned(String::from_utf8_lossy(&bytes).into_owned()),
                        Some(bytes.into()),
                    )
                }
            },
        };
        Text { text, span, raw }
    }

    /// The file that the string names: its very bytes, where the system has such names.
    pub fn path(&self) -> PathBuf {
        match &self.raw {
            Some(raw) => path_of_bytes(raw),
            None => PathBuf::from(&*self.text),
        }
    }

    /// A copy that outlives the file.
    fn to_owned(&self) -> Text<'static> {
        Text {
            text: Cow::Owned(self.text.clone().into_owned()),
            span: self.span.clone(),
            raw: self.raw.clone(),
        }
    }
}

#[cfg(unix)]
fn path_of_bytes(bytes: &[u8]) -> PathBuf {
    use std::os::unix::ffi::OsStrExt;
    PathBuf::from(std::ffi::OsStr::from_bytes(bytes))
}

#[cfg(not(unix))]
fn path_of_bytes(bytes: &[u8]) -> PathBuf {
    PathBuf::from(&*String::from_utf8_lossy(bytes))
}

/// Something that has a type and parameters: a camera, a film, a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Entity<'a> {
    /// Its type, such as `perspective`.
    pub name: Text<'a>,
    /// Its parameters in the order of the file; a name may occur twice.
    pub parameters: Vec<Parameter<'a>>,
}

/// A declaration such as `"float fov"` and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter<'a> {
    /// The declared type as it is spelled, such as `point` or `point3`.
    pub type_name: Cow<'a, str>,
    /// The declared name.
    pub name: Cow<'a, str>,
    /// The declaration with its quotes.
    pub span: Span,
    /// What it is set to.
    pub values: Values<'a>,
    /// The values with their brackets.
    pub values_span: Span,
}

impl Parameter<'_> {
    /// A copy that outlives the text.
    pub fn to_owned(&self) -> Parameter<'static> {
        Parameter {
            type_name: Cow::Owned(self.type_name.clone().into_owned()),
            name: Cow::Owned(self.name.clone().into_owned()),
            span: self.span.clone(),
            values: self.values.to_owned(),
            values_span: self.values_span.clone(),
        }
    }
}

/// The values of a parameter. Their kind is that of the file, it need not fit the declared type.
#[derive(Debug, Clone, PartialEq)]
pub enum Values<'a> {
    /// Numbers; infinite where they are beyond the range of `f64`.
    Numbers(Vec<f64>),
    /// Quoted strings.
    Strings(Vec<Text<'a>>),
    /// `true` and `false`, in quotes too where the declared type is `bool`.
    Booleans(Vec<bool>),
    /// An empty array.
    None,
}

impl Values<'_> {
    /// A copy that outlives the text.
    fn to_owned(&self) -> Values<'static> {
        match self {
            Values::Numbers(numbers) => Values::Numbers(numbers.clone()),
            Values::Strings(texts) => Values::Strings(texts.iter().map(Text::to_owned).collect()),
            Values::Booleans(booleans) => Values::Booleans(booleans.clone()),
            Values::None => Values::None,
        }
    }
}
