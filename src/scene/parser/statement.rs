//! What the directives of a scene file state, before anything is interpreted.

use crate::scene::source_file::Span;
use std::borrow::Cow;
use std::path::PathBuf;

/// A directive with its arguments. Numbers are as in the file: angles in degrees, matrices column
/// by column.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement<'a> {
    /// A directive that multiplies or replaces the current transform.
    Transform(TransformDirective),
    /// `ActiveTransform StartTime | EndTime | All`
    ActiveTransform(ActiveTransform),
    /// `CoordinateSystem "name"`
    CoordinateSystem(Text<'a>),
    /// `CoordSysTransform "name"`
    CoordSysTransform(Text<'a>),
    /// `ReverseOrientation`
    ReverseOrientation,
    /// `AttributeBegin`
    AttributeBegin,
    /// `AttributeEnd`
    AttributeEnd,
    /// `TransformBegin`
    TransformBegin,
    /// `TransformEnd`
    TransformEnd,
    /// `Attribute "target" parameters`: defaults for what follows. The entity's name is the target.
    Attribute(Entity<'a>),
    /// `WorldBegin`
    WorldBegin,
    /// `WorldEnd`
    WorldEnd,
    /// `Include "file"`: the file replaces the directive.
    Include(Text<'a>),
    /// `Import "file"`: the file is read with a copy of the graphics state.
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
    /// `Texture "name" "float" "type" parameters`
    Texture(TextureDirective<'a>),
    /// `AreaLightSource "type" parameters`: only its presence is kept.
    AreaLightSource,
    /// A directive that hits and depths do not depend on. Its syntax has been checked.
    Skipped,
    /// A directive that no version of pbrt knows, by its keyword.
    Unknown(&'a str),
}

/// A directive that changes the current transform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransformDirective {
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
}

/// Which transforms of a moving scene the directives that follow change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActiveTransform {
    /// The transform at the start time.
    StartTime,
    /// The transform at the end time.
    EndTime,
    /// Both.
    All,
}

/// A quoted string.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text<'a> {
    /// The characters between the quotes, escapes undone; bytes that are not UTF-8 are replaced.
    pub text: Cow<'a, str>,
    /// The string with its quotes.
    pub span: Span,
    /// The bytes between the quotes, escapes undone, if they are not UTF-8.
    pub raw: Option<Box<[u8]>>,
}

impl<'a> Text<'a> {
    /// The string that stands at `span` and means `bytes`.
    pub(crate) fn new(bytes: Cow<'a, [u8]>, span: Span) -> Text<'a> {
        let (text, raw) = match bytes {
            Cow::Borrowed(bytes) => match std::str::from_utf8(bytes) {
                Ok(text) => (Cow::Borrowed(text), None),
                Err(_) => (String::from_utf8_lossy(bytes), Some(bytes.into())),
            },
            Cow::Owned(bytes) => match String::from_utf8(bytes) {
                Ok(text) => (Cow::Owned(text), None),
                Err(error) => {
                    let bytes = error.into_bytes();
                    let text = String::from_utf8_lossy(&bytes).into_owned();
                    (Cow::Owned(text), Some(bytes.into()))
                }
            },
        };
        Text { text, span, raw }
    }

    /// The file that the string names, byte for byte if the system has such names.
    pub fn path(&self) -> PathBuf {
        match &self.raw {
            Some(raw) => path_of_bytes(raw),
            None => PathBuf::from(&*self.text),
        }
    }

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

/// Anything with a type and parameters: a camera, a film, a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Entity<'a> {
    /// Its type, such as `perspective`.
    pub name: Text<'a>,
    /// Its parameters in the order of the file; a name may occur twice.
    pub parameters: Vec<Parameter<'a>>,
}

/// A texture whose values are numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureDirective<'a> {
    /// The name that shapes and other textures use.
    pub name: Text<'a>,
    /// Its type, such as `imagemap`, and its parameters.
    pub entity: Entity<'a>,
}

impl Entity<'_> {
    /// A copy that outlives the text.
    pub fn to_owned(&self) -> Entity<'static> {
        Entity {
            name: self.name.to_owned(),
            parameters: self.parameters.iter().map(Parameter::to_owned).collect(),
        }
    }
}

/// A declaration such as `"float fov"`, and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter<'a> {
    /// The declared type as it is spelled, such as `point` or `point3`.
    pub type_name: Cow<'a, str>,
    /// The declared name.
    pub name: Cow<'a, str>,
    /// The declaration with its quotes.
    pub span: Span,
    /// The values.
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

/// The values of a parameter. Their kind is the one in the file; the declared type may differ.
#[derive(Debug, Clone, PartialEq)]
pub enum Values<'a> {
    /// Numbers; infinite if they are out of the range of `f64`.
    Numbers(Vec<f64>),
    /// Quoted strings.
    Strings(Vec<Text<'a>>),
    /// `true` and `false`; also in quotes if the declared type is `bool`.
    Booleans(Vec<bool>),
    /// An empty array.
    None,
}

impl Values<'_> {
    fn to_owned(&self) -> Values<'static> {
        match self {
            Values::Numbers(numbers) => Values::Numbers(numbers.clone()),
            Values::Strings(texts) => Values::Strings(texts.iter().map(Text::to_owned).collect()),
            Values::Booleans(booleans) => Values::Booleans(booleans.clone()),
            Values::None => Values::None,
        }
    }
}

/// The type and name that the first string of a parameter declares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Declaration<'a> {
    pub(super) type_name: Cow<'a, str>,
    pub(super) name: Cow<'a, str>,
    /// The string with its quotes.
    pub(super) span: Span,
}

/// The types whose values are numbers, in every version of pbrt.
pub const NUMBER_TYPES: [&str; 11] = [
    "float",
    "integer",
    "normal",
    "normal3",
    "point",
    "point2",
    "point3",
    "vector",
    "vector2",
    "vector3",
    "blackbody",
];

impl Declaration<'_> {
    /// Whether `text` must be the next declaration because this parameter takes numbers.
    pub(super) fn is_followed_by_another(&self, text: &str) -> bool {
        NUMBER_TYPES.contains(&&*self.type_name) && text.split_whitespace().count() == 2
    }

    /// Whether the string whose opening quote is followed by `inside` has two words.
    pub(super) fn is_like(inside: &[u8]) -> bool {
        let is_end = |byte: &u8| matches!(byte, b'"' | b'\n' | b'\r');
        let end = inside.iter().position(is_end).unwrap_or(inside.len());
        let words = inside[..end].split(u8::is_ascii_whitespace);
        words.filter(|word| !word.is_empty()).count() == 2
    }
}
