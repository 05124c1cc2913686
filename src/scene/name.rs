//! Names that a scene gives to objects, coordinate systems, materials and textures.

use crate::scene::parser::Text;
use std::borrow::{Borrow, Cow};
use std::fmt::{self, Display, Formatter};
use unicode_normalization::{IsNormalized, UnicodeNormalization, is_nfc_quick};

/// A name in Unicode's normalisation form C, in which pbrt-v4 compares names, too. A name that is
/// not UTF-8 is kept as it is.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Name(Box<[u8]>);

impl Name {
    pub(crate) fn new(text: &Text) -> Name {
        Name(key(text).into_owned().into_boxed_slice())
    }
}

impl From<&str> for Name {
    fn from(name: &str) -> Name {
        Name(normalized(name).into_owned().into_boxed_slice())
    }
}

/// Looks up names by their [`key`], without a copy.
impl Borrow<[u8]> for Name {
    fn borrow(&self) -> &[u8] {
        &self.0
    }
}

impl Display for Name {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&String::from_utf8_lossy(&self.0))
    }
}

/// The bytes that all spellings of one name share.
pub(crate) fn key<'a>(text: &'a Text) -> Cow<'a, [u8]> {
    match &text.raw {
        Some(raw) => Cow::Borrowed(raw),
        None => normalized(&text.text),
    }
}

fn normalized(name: &str) -> Cow<'_, [u8]> {
    match is_nfc_quick(name.chars()) {
        IsNormalized::Yes => Cow::Borrowed(name.as_bytes()),
        _ => Cow::Owned(name.nfc().collect::<String>().into_bytes()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(bytes: &[u8]) -> Name {
        Name::new(&Text::new(Cow::Borrowed(bytes), 0..0))
    }

    #[test]
    fn composed_and_decomposed_spellings_are_one_name() {
        assert_eq!(name("caf\u{e9}".as_bytes()), name("cafe\u{301}".as_bytes()));
        assert_ne!(name(b"cafe"), name("caf\u{e9}".as_bytes()));
        assert_ne!(
            name("\u{fb01}".as_bytes()),
            name(b"fi"),
            "compatible characters differ"
        );
    }

    #[test]
    fn names_that_are_not_utf8_differ_if_their_bytes_do() {
        assert_ne!(name(b"caf\xe9"), name(b"caf\xe8"));
        assert_ne!(name(b"caf\xe9"), name("caf\u{fffd}".as_bytes()));
        assert_eq!(name(b"caf\xe9"), name(b"caf\xe9"));
    }
}
