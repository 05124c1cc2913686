//! The table of directives: keyword, arguments, where each is legal, and what it means.

use super::statement::{
    ActiveTransform, Entity, Statement, Text, TextureDirective, TransformDirective,
};
use crate::scene::source_file::Span;

/// One directive and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Directive<'a> {
    /// From the keyword to the end of the last argument.
    pub span: Span,
    /// The keyword alone.
    pub keyword: Span,
    /// Its description; `None` for an unknown directive.
    pub description: Option<Description>,
    /// The directive with its arguments.
    pub statement: Statement<'a>,
}

/// What the table says about a directive, apart from its arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Description {
    /// The index of the keyword in [`KEYWORDS`].
    pub number: usize,
    /// Where in a scene it may stand.
    pub legal: Legal,
    /// Whether hits and depths depend on it. The census lists the others as skipped.
    pub matters: bool,
}

/// Where in a scene a directive may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Legal {
    /// Before and after `WorldBegin`.
    Anywhere,
    /// Before `WorldBegin`.
    BeforeWorld,
    /// After `WorldBegin`.
    InWorld,
}

/// The arguments of a directive, and the statement that they make.
#[derive(Clone, Copy)]
pub(super) enum Arguments<'a> {
    None(fn() -> Statement<'a>),
    Identity,
    Three(fn([f64; 3]) -> TransformDirective),
    Four(fn([f64; 4]) -> TransformDirective),
    Nine(fn([f64; 9]) -> TransformDirective),
    Sixteen(fn([f64; 16]) -> TransformDirective),
    /// `StartTime`, `EndTime` or `All`.
    Times(fn(ActiveTransform) -> Statement<'a>),
    /// A string.
    Name(fn(Text<'a>) -> Statement<'a>),
    /// A string, and parameters that are dropped.
    Type(fn(Text<'a>) -> Statement<'a>),
    /// A string and parameters.
    Entity(fn(Entity<'a>) -> Statement<'a>),
    /// Three strings and parameters; `None` unless its values are numbers.
    Texture(fn(Option<TextureDirective<'a>>) -> Statement<'a>),
    /// Arguments that are checked and dropped.
    Dropped(&'static [Dropped], fn() -> Statement<'a>),
}

/// An argument of which only the syntax is checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dropped {
    TwoNumbers,
    Text,
    OptionalText,
    Parameters,
    /// `"name" value` or `"type name" value`.
    Option,
}

/// One row of the table.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    keyword: &'static str,
    pub(super) arguments: Arguments<'a>,
    pub(super) legal: Legal,
    pub(super) matters: bool,
}

const COUNT: usize = 45;

impl<'a> Row<'a> {
    /// Every directive of pbrt-v2, v3 and v4, sorted by keyword.
    pub(super) const ALL: [Row<'a>; COUNT] = {
        use Arguments::{
            Dropped, Entity, Four, Identity, Name, Nine, None, Sixteen, Texture, Three, Times, Type,
        };
        use Legal::{Anywhere, BeforeWorld, InWorld};
        use Statement as S;
        use TransformDirective as T;
        [
            Row::new("Accelerator", Entity(S::Accelerator), Anywhere),
            Row::new("ActiveTransform", Times(S::ActiveTransform), Anywhere),
            Row::skipped("AreaLightSource", Dropped(&ENTITY, || S::AreaLightSource)),
            Row::new("Attribute", Entity(S::Attribute), Anywhere),
            Row::new("AttributeBegin", None(|| S::AttributeBegin), Anywhere),
            Row::new("AttributeEnd", None(|| S::AttributeEnd), Anywhere),
            Row::new("Camera", Entity(S::Camera), BeforeWorld),
            Row::skipped("ColorSpace", dropped(&[D::Text])),
            Row::new("ConcatTransform", Sixteen(T::ConcatTransform), Anywhere),
            Row::new("CoordSysTransform", Name(S::CoordSysTransform), Anywhere),
            Row::new("CoordinateSystem", Name(S::CoordinateSystem), Anywhere),
            Row::new("Film", Entity(S::Film), BeforeWorld),
            Row::new("Identity", Identity, Anywhere),
            Row::new("Import", Name(S::Import), InWorld),
            Row::new("Include", Name(S::Include), Anywhere),
            Row::skipped("Integrator", dropped(&ENTITY)),
            Row::skipped("LightSource", dropped(&ENTITY)),
            Row::new("LookAt", Nine(T::LookAt), Anywhere),
            Row::skipped("MakeNamedMaterial", Entity(S::MakeNamedMaterial)),
            Row::skipped("MakeNamedMedium", dropped(&ENTITY)),
            Row::skipped("Material", Type(S::Material)),
            Row::skipped("MediumInterface", dropped(&[D::Text, D::OptionalText])),
            Row::skipped("NamedMaterial", Name(S::NamedMaterial)),
            Row::new("ObjectBegin", Name(S::ObjectBegin), InWorld),
            Row::new("ObjectEnd", None(|| S::ObjectEnd), Anywhere),
            Row::new("ObjectInstance", Name(S::ObjectInstance), InWorld),
            Row::skipped("Option", dropped(&[D::Option])),
            Row::skipped("PixelFilter", dropped(&ENTITY)),
            Row::skipped("Renderer", dropped(&ENTITY)),
            Row::new(
                "ReverseOrientation",
                None(|| S::ReverseOrientation),
                Anywhere,
            ),
            Row::new("Rotate", Four(T::Rotate), Anywhere),
            Row::skipped("Sampler", dropped(&ENTITY)),
            Row::new("Scale", Three(T::Scale), Anywhere),
            Row::new("Shape", Entity(S::Shape), InWorld),
            Row::skipped("SurfaceIntegrator", dropped(&ENTITY)),
            Row::skipped(
                "Texture",
                Texture(|texture| texture.map_or(S::Skipped, S::Texture)),
            ),
            Row::new("Transform", Sixteen(T::Transform), Anywhere),
            Row::new("TransformBegin", None(|| S::TransformBegin), Anywhere),
            Row::new("TransformEnd", None(|| S::TransformEnd), Anywhere),
            Row::skipped("TransformTimes", dropped(&[D::TwoNumbers])),
            Row::new("Translate", Three(T::Translate), Anywhere),
            Row::skipped("Volume", dropped(&ENTITY)),
            Row::skipped("VolumeIntegrator", dropped(&ENTITY)),
            Row::new("WorldBegin", None(|| S::WorldBegin), BeforeWorld),
            Row::new("WorldEnd", None(|| S::WorldEnd), InWorld),
        ]
    };

    const fn new(keyword: &'static str, arguments: Arguments<'a>, legal: Legal) -> Row<'a> {
        Row {
            keyword,
            arguments,
            legal,
            matters: true,
        }
    }

    const fn skipped(keyword: &'static str, arguments: Arguments<'a>) -> Row<'a> {
        Row {
            keyword,
            arguments,
            legal: Legal::Anywhere,
            matters: false,
        }
    }
}

use Dropped as D;

const ENTITY: [Dropped; 2] = [D::Text, D::Parameters];

const fn dropped<'a>(arguments: &'static [Dropped]) -> Arguments<'a> {
    Arguments::Dropped(arguments, || Statement::Skipped)
}

/// The keywords of all directives, sorted.
pub const KEYWORDS: [&str; COUNT] = {
    let mut keywords = [""; COUNT];
    let mut number = 0;
    while number < COUNT {
        keywords[number] = Row::ALL[number].keyword;
        number += 1;
    }
    keywords
};

/// Where the keywords of each capital letter begin, from `A` on, and where those of `Z` end.
const FIRST: [usize; 27] = {
    let mut first = [COUNT; 27];
    let mut number = COUNT;
    let mut letter = 26;
    while letter > 0 {
        letter -= 1;
        while number > 0 && KEYWORDS[number - 1].as_bytes()[0] >= b'A' + letter as u8 {
            number -= 1;
        }
        first[letter] = number;
    }
    first
};

/// The index in [`KEYWORDS`] of the keyword `word`.
pub(super) fn number(word: &[u8]) -> Option<usize> {
    let letter = word.first().filter(|byte| byte.is_ascii_uppercase())? - b'A';
    let mut numbers = FIRST[usize::from(letter)]..FIRST[usize::from(letter) + 1];
    numbers.find(|number| KEYWORDS[*number].as_bytes() == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_keyword_is_found() {
        assert!(KEYWORDS.is_sorted());
        for (index, keyword) in KEYWORDS.iter().enumerate() {
            assert_eq!(number(keyword.as_bytes()), Some(index));
        }
        for word in [
            "shape", "", "S", "Shapes", "Zoo", "Apple", "\u{e4}", "[", "0",
        ] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
    }
}
