//! What holds for every input.

use proptest::prelude::*;

use super::super::{Directive, Statement, Values};
use super::parse;

const SCENE: &[u8] = br#"LookAt 3 4 1.5  .5 .5 0  0 0 1 # eye
Camera "perspective" "float fov" 45
Film "rgb" "string filename" ["simple.png"] "integer xresolution" [400]
WorldBegin
ActiveTransform All
Option "disablepixeljitter" true
Texture "checks" "spectrum" "checkerboard" "float uscale" [16] "rgb tex1" [.1 .1 .1]
MediumInterface "a\"b" ""
AttributeBegin
  Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1]
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1e3 0 0, 1 0 inf  0 1 0] "bool b" "true"
AttributeEnd
"#;

/// Directives lie in the source, one after the other.
fn check_spans(directives: &[Directive], length: usize) {
    let mut end = 0;
    for directive in directives {
        assert!(end <= directive.span.start && directive.span.start == directive.keyword.start);
        assert!(directive.keyword.end <= directive.span.end && directive.span.end <= length);
        end = directive.span.end;
    }
}

/// Either answer will do, as long as there is one.
fn survives(source: &[u8]) {
    match parse(source) {
        Ok(directives) => check_spans(&directives, source.len()),
        Err(error) => assert!(error.to_string().starts_with("a.pbrt")),
    }
}

#[test]
fn survives_the_scene_cut_anywhere() {
    for end in 0..=SCENE.len() {
        survives(&SCENE[..end]);
    }
    assert_eq!(parse(SCENE).expect("directives").len(), 12);
}

#[test]
fn survives_long_tokens_and_deep_brackets() {
    for piece in [
        "[",
        "]",
        "\"",
        "\\",
        "9",
        "x",
        "#",
        ",",
        " ",
        "Shape ",
        "Shape \"",
        "AttributeBegin ",
    ] {
        survives(piece.repeat(200_000).as_bytes());
        survives(format!("Shape \"s\" \"float f\" [ {}", piece.repeat(200_000)).as_bytes());
    }
}

proptest! {
    #[test]
    fn survives_any_bytes(source in proptest::collection::vec(any::<u8>(), 0..200)) {
        survives(&source);
    }

    #[test]
    fn survives_any_words(
        words in proptest::collection::vec("(Shape|Foo|Scale|Texture|Option|\"|\\[|\\]|\"float f\"|\"a\"|1|true|#|,|\\\\|\n|é)", 0..30)
    ) {
        survives(words.concat().as_bytes());
        survives(words.join(" ").as_bytes());
    }

    #[test]
    fn survives_any_mutation(
        edits in proptest::collection::vec((0..SCENE.len(), prop_oneof![any::<u8>(), Just(b'"'), Just(b'['), Just(b']')]), 1..5),
        removed in 0..SCENE.len(), length in 0..20_usize,
    ) {
        let mut source = SCENE.to_vec();
        for (at, byte) in edits {
            source[at] = byte;
        }
        source.drain(removed..(removed + length).min(SCENE.len()));
        survives(&source);
    }

    #[test]
    fn numbers_come_back_bit_for_bit(bits in proptest::collection::vec(any::<u64>(), 1..20)) {
        let numbers: Vec<f64> = bits.into_iter().map(f64::from_bits).filter(|number| !number.is_nan()).collect();
        prop_assume!(!numbers.is_empty());
        let written: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
        let source = format!("Shape \"s\" \"float f\" [{}]", written.join(" "));
        let directives = parse(source.as_bytes()).expect("directives");
        let Statement::Shape(shape) = &directives[0].statement else { panic!("no shape") };
        let Values::Numbers(read) = &shape.parameters[0].values else { panic!("no numbers") };
        let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
        prop_assert_eq!(bits(read), bits(&numbers));
    }
}
