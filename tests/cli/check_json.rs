//! `feimos check --json`: a line for each scene, with all that the text has.

use crate::folder::{Folder, WARNED};
use serde_json::{Value, json};

#[test]
fn json_has_a_line_for_each_scene() {
    let folder = Folder::new()
        .with("warned.pbrt", WARNED)
        .with("bad.pbrt", "Shap");
    let run = folder
        .check("warned.pbrt bad.pbrt ball.pbrt --json --strict")
        .exited(65);
    let [warned, bad, ball] = &run.json()[..] else {
        panic!("{run:?}")
    };
    assert_eq!(
        (&warned["scene"], &warned["exit_code"], &warned["error"]),
        (&json!("warned.pbrt"), &json!(1), &Value::Null)
    );
    let [warning] = &warned["warnings"].as_array().unwrap()[..] else {
        panic!("{warned}")
    };
    assert_eq!(
        (&warning["place"], &warning["count"]),
        (&json!("warned.pbrt:2:7"), &json!(2))
    );
    assert!(
        warning["message"]
            .as_str()
            .unwrap()
            .contains("is not supported"),
        "{warning}"
    );
    assert!(
        warning["kind"].is_string() && warning["notes"].is_array(),
        "{warning}"
    );
    let error = json!({
        "message": "unknown directive `Shap`", "place": "bad.pbrt:1:1", "notes": ["did you mean `Shape`?"]
    });
    assert_eq!(
        *bad,
        json!({"scene": "bad.pbrt", "exit_code": 65, "error": error, "warnings": []})
    );
    assert_eq!(
        (&ball["exit_code"], &ball["primitives"], &ball["bytes"]),
        (&json!(0), &json!(2), &json!(348))
    );
    run.said("error: bad.pbrt:1:1")
        .said("warning: warned.pbrt:2:7");
}

#[test]
fn json_has_everything_that_text_has() {
    let run = Folder::new().check("ball.pbrt --json -q").succeeded();
    let [line] = &run.json()[..] else {
        panic!("{run:?}")
    };
    assert_eq!(line["camera"]["projection"], "perspective");
    assert!((line["camera"]["fov"].as_f64().unwrap() - 40.0).abs() < 1e-9);
    assert_eq!(line["camera"]["eye"], json!([0.0, 0.0, -5.0]));
    assert_eq!(
        line["film"],
        json!({"width": 13, "height": 7, "crop": [0, 13, 0, 7], "filename": "film.exr"})
    );
    let one = json!({"statements": 1, "primitives": 1, "left_out": false});
    assert_eq!(line["shapes"], json!({"sphere": one, "trianglemesh": one}));
    assert_eq!(line["bounds"]["high"], json!([2.5, 2.0, 2.5]));
    assert_eq!(
        (&line["statements"], &line["triangles"], &line["transforms"]),
        (&json!(2), &json!(1), &json!(2))
    );
    let directives =
        json!({"Camera": 1, "Film": 1, "LookAt": 1, "Shape": 2, "Translate": 1, "WorldBegin": 1});
    assert_eq!(
        (&line["directives"], &line["skipped"], &line["unknown"]),
        (&directives, &json!({}), &json!({}))
    );
    let empty = Folder::new()
        .with("a.pbrt", "WorldBegin")
        .check("a.pbrt --json")
        .succeeded();
    assert_eq!(empty.json()[0]["bounds"], Value::Null);
}
