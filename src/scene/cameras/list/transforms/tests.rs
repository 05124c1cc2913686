//! Mistakes in the files of NeRF programs.

use super::super::parse_poses;
use std::path::Path;

const MATRIX: &str = r#""transform_matrix": [[1,0,0,4], [0,1,0,5], [0,0,1,6], [0,0,0,1]]"#;

fn refused(text: &str, expected: &str) {
    let message = parse_poses(Path::new("t.json"), text.as_bytes())
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("t.json") && message.contains(expected),
        "{text}: {message}"
    );
}

#[test]
fn mistakes_are_reported_with_the_frame() {
    let file = |shared: &str, frame: &str| {
        format!("{{{shared} \"frames\": [{{\"file_path\": \"a/b.png\", {frame}}}]}}")
    };
    let sized = r#""fl_x": 50, "w": 4, "h": 3,"#;
    for (shared, frame, expected) in [
        ("", MATRIX, "frame 1, `b`: no focal length"),
        (sized, "\"fl_y\": 2", "no `transform_matrix`"),
        ("\"fl_x\": 5,", MATRIX, "without `w` and `h`"),
        (
            r#""fl_x": 5, "w": 4.5, "h": 3,"#,
            MATRIX,
            "images of 4.5 x 3 pixels",
        ),
        (
            r#""fl_x": -5, "w": 4, "h": 3,"#,
            MATRIX,
            "not that of a pinhole",
        ),
        (r#""camera_angle_x": 4,"#, MATRIX, "an angle of 4 across"),
        (
            r#""camera_model": "FISHEYE624","#,
            MATRIX,
            "the camera model FISHEYE624",
        ),
        (
            r#""fl_x": 5, "w": 4, "h": 3, "cx": 2,"#,
            MATRIX,
            "`cx` or `cy` alone",
        ),
        (
            r#""fl_x": 5, "w": 4, "h": 3, "k5": 2,"#,
            MATRIX,
            "`k5` or `k6`",
        ),
        (
            r#""camera_angle_x": 1, "is_fisheye": true,"#,
            MATRIX,
            "`camera_angle_x` of a fisheye",
        ),
        (
            sized,
            &MATRIX.replace("[0,0,1,6]", "[0,0,2,6]"),
            "not a rotation",
        ),
        (
            sized,
            &MATRIX.replace("[0,0,1,6]", "[0,0,-1,6]"),
            "not a rotation",
        ),
        (sized, &MATRIX.replace("[0,0,0,1]", "[0,0,0,2]"), "frame 1"),
    ] {
        refused(&file(shared, frame), expected);
    }
    refused("{\"frames\": []}", "a list of 0 cameras");
    refused("{\"frames\": [7]}", "frame 1: invalid type: integer `7`");
    refused("{\"frames\": 7}", "`frames`: invalid type: integer `7`");
}
