//! Every form of directive and of value.

use super::super::{
    ActiveTransform, KEYWORDS, Statement as S, TextureDirective, TransformDirective as T, Values,
};
use super::{parameters, parse, statement, statements, values};

const MATRIX: [f64; 16] = [
    1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15., 16.,
];
const ROWS: &str = "1 2 3 4  5 6 7 8\n9 10 11 12  13 14 15 16";

#[test]
fn directives_without_arguments() {
    let source = "Identity ReverseOrientation AttributeBegin AttributeEnd TransformBegin TransformEnd \
                  WorldBegin WorldEnd ObjectEnd";
    let expected = [
        S::Transform(T::Identity),
        S::ReverseOrientation,
        S::AttributeBegin,
        S::AttributeEnd,
        S::TransformBegin,
        S::TransformEnd,
        S::WorldBegin,
        S::WorldEnd,
        S::ObjectEnd,
    ];
    assert_eq!(statements(source), expected);
}

#[test]
fn fixed_numbers_with_and_without_brackets() {
    let nine = [1., 2., 3., 4., 5., 6., 7., 8., 9.];
    let cases = [
        (
            "Translate",
            "1 -2 3e0",
            S::Transform(T::Translate([1., -2., 3.])),
        ),
        ("Scale", "1 2 3", S::Transform(T::Scale([1., 2., 3.]))),
        (
            "Rotate",
            "90 0 0 1",
            S::Transform(T::Rotate([90., 0., 0., 1.])),
        ),
        (
            "LookAt",
            "1 2 3  4 5 6  7 8 9",
            S::Transform(T::LookAt(nine)),
        ),
        ("Transform", ROWS, S::Transform(T::Transform(MATRIX))),
        (
            "ConcatTransform",
            ROWS,
            S::Transform(T::ConcatTransform(MATRIX)),
        ),
        ("TransformTimes", "0 1", S::Skipped),
    ];
    for (keyword, numbers, expected) in cases {
        assert_eq!(statement(&format!("{keyword} {numbers}")), expected);
        assert_eq!(statement(&format!("{keyword}[{numbers}]")), expected);
        assert_eq!(
            statement(&format!("{keyword} [ {numbers} # note\n ]")),
            expected
        );
    }
}

#[test]
fn directives_with_a_string() {
    for keyword in [
        "CoordinateSystem",
        "CoordSysTransform",
        "Include",
        "Import",
        "ObjectBegin",
        "ObjectInstance",
    ] {
        let source = format!("{keyword} \"a b\"");
        let text = match statement(&source) {
            S::CoordinateSystem(text) | S::CoordSysTransform(text) => text,
            S::Include(text) | S::Import(text) | S::ObjectBegin(text) | S::ObjectInstance(text) => {
                text
            }
            other => panic!("{other:?}"),
        };
        assert_eq!(text.text, "a b");
        assert_eq!(&source[text.span], "\"a b\"");
    }
}

#[test]
fn directives_with_parameters() {
    for keyword in ["Camera", "Film", "Accelerator", "Shape", "Attribute"] {
        let source = format!("{keyword} \"type\" \"float a\" 1 \"point3 P\" [0 1 2]");
        let entity = match statement(&source) {
            S::Camera(entity) | S::Film(entity) | S::Accelerator(entity) | S::Shape(entity) => {
                entity
            }
            S::Attribute(entity) => entity,
            other => panic!("{other:?}"),
        };
        assert_eq!(entity.name.text, "type");
        let [a, p] = &entity.parameters[..] else {
            panic!("{entity:?}")
        };
        assert_eq!(
            (&*a.type_name, &*a.name, &a.values),
            ("float", "a", &Values::Numbers(vec![1.]))
        );
        assert_eq!(
            (&*p.type_name, &*p.name, &p.values),
            ("point3", "P", &Values::Numbers(vec![0., 1., 2.]))
        );
        assert_eq!(&source[p.span.clone()], "\"point3 P\"");
        assert_eq!(&source[p.values_span.clone()], "[0 1 2]");
    }
}

#[test]
fn active_transforms() {
    assert_eq!(
        statement("ActiveTransform StartTime"),
        S::ActiveTransform(ActiveTransform::StartTime)
    );
    assert_eq!(
        statement("ActiveTransform EndTime"),
        S::ActiveTransform(ActiveTransform::EndTime)
    );
    assert_eq!(
        statement("ActiveTransform All"),
        S::ActiveTransform(ActiveTransform::All)
    );
}

#[test]
fn directives_without_influence() {
    let cases = [
        "ColorSpace \"aces2065-1\"",
        "MediumInterface \"a\"",
        "MediumInterface \"a\" \"\"",
        "Option \"disablepixeljitter\" true",
        "Option \"bool disablepixeljitter\" \"true\"",
        "Option \"string rendercoordsys\" [\"world\"]",
        "Texture \"t\" \"spectrum\" \"checkerboard\" \"float uscale\" [16] \"rgb tex1\" [.1 .1 .1]",
        "LightSource \"distant\" \"blackbody L\" [3000 1] \"point from\" [0 0 0]",
    ];
    for case in cases {
        assert_eq!(statement(case), S::Skipped, "{case}");
    }
}

/// Shapes may use textures of numbers, whatever their parameters.
#[test]
fn textures_of_numbers_are_kept() {
    let kept = |text: &str| match statement(text) {
        S::Texture(TextureDirective { name, entity }) => (
            name.text.into_owned(),
            entity.name.text.into_owned(),
            entity.parameters.len(),
        ),
        other => panic!("{other:?}"),
    };
    let texture = "Texture \"t\" \"float\"";
    assert_eq!(
        kept(&format!("{texture} \"constant\"")),
        ("t".into(), "constant".into(), 0)
    );
    let parameters = "\"texture a\" \"t\" \"bool remap\" false \"spectrum k\" []";
    assert_eq!(
        kept(&format!("{texture} \"mix\" {parameters}")),
        ("t".into(), "mix".into(), 3)
    );
}

#[test]
fn every_keyword_takes_one_of_these_forms() {
    let arguments = [
        "",
        "1 2",
        "1 2 3",
        "1 2 3 4",
        "1 2 3 4 5 6 7 8 9",
        ROWS,
        "All",
        "\"a\"",
        "\"a\" 1",
        "\"a\" \"b\" \"c\"",
    ];
    for keyword in KEYWORDS {
        let takes = |arguments: &&str| {
            parse(format!("{keyword} {arguments}").as_bytes()).is_ok_and(|d| d.len() == 1)
        };
        assert!(arguments.iter().any(takes), "{keyword}");
    }
}

#[test]
fn spans_end_with_the_last_argument() {
    let source = "WorldBegin # here\n  Translate 1 2 3  # there\n Shape \"s\" \"float r\" 1 # end\nScale [1 1 1] \n";
    let directives = parse(source.as_bytes()).expect("directives");
    let text: Vec<&str> = directives.iter().map(|d| &source[d.span.clone()]).collect();
    assert_eq!(
        text,
        [
            "WorldBegin",
            "Translate 1 2 3",
            "Shape \"s\" \"float r\" 1",
            "Scale [1 1 1]"
        ]
    );
    let keywords: Vec<&str> = directives
        .iter()
        .map(|d| &source[d.keyword.clone()])
        .collect();
    assert_eq!(keywords, ["WorldBegin", "Translate", "Shape", "Scale"]);
}

#[test]
fn values_of_every_kind() {
    let strings = |source| match values(source) {
        Values::Strings(texts) => texts
            .into_iter()
            .map(|t| t.text.into_owned())
            .collect::<Vec<_>>(),
        other => panic!("{other:?}"),
    };
    assert_eq!(values("\"float r\" 1.5"), Values::Numbers(vec![1.5]));
    assert_eq!(
        values("\"integer indices\" [0 1 2]"),
        Values::Numbers(vec![0., 1., 2.])
    );
    assert_eq!(
        values("\"point P\"[0,1,2,]"),
        Values::Numbers(vec![0., 1., 2.])
    );
    assert_eq!(strings("\"string filename\" \"a.ply\""), ["a.ply"]);
    assert_eq!(
        strings("\"string filename\" [ \"a\"\"b\" , \"c\" ]"),
        ["a", "b", "c"]
    );
    assert_eq!(strings("\"string s\" [ \"true\" ]"), ["true"]);
    assert_eq!(strings("\"string s\" \"float fov\""), ["float fov"]);
    assert_eq!(values("\"bool b\" true"), Values::Booleans(vec![true]));
    assert_eq!(
        values("\"bool b\" [ true false ]"),
        Values::Booleans(vec![true, false])
    );
    assert_eq!(
        values("\"bool b\" \"false\""),
        Values::Booleans(vec![false])
    );
    assert_eq!(
        values("\"bool b\" [ \"true\" \"false\" ]"),
        Values::Booleans(vec![true, false])
    );
    assert_eq!(values("\"spectrum s\" [ ]"), Values::None);
    assert_eq!(values("\"spectrum s\" [ # nothing\n]"), Values::None);
}

#[test]
fn a_name_may_occur_twice() {
    assert_eq!(
        parameters("Shape \"s\" \"float r\" 1 \"float r\" 2").len(),
        2
    );
}
