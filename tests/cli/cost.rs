//! The channel and the view of ray costs.

use crate::folder::Folder;

#[test]
fn the_channel_is_written_on_request() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --aov Z,cost --accel none");
    assert_eq!(
        (exr.channels(), exr.integers.as_slice()),
        (vec!["Z", "cost"], &["cost".to_owned()][..])
    );
    // One node around both, and where the ray meets it, both.
    assert!(
        exr.bits["cost"].iter().all(|cost| [1, 3].contains(cost)) && exr.bits["cost"].contains(&3)
    );
    assert!(
        exr.header["cost"]
            .as_str()
            .unwrap()
            .contains("nodes and primitives")
    );
    assert_eq!(
        folder.rendered("ball.pbrt").header["cost"],
        serde_json::Value::Null
    );
    let crop = folder.rendered(
        "ball.pbrt --aov cost --pixelbounds 4,9,2,6 --threads 1 --precision fast --accel none",
    );
    let rows = (2..6).flat_map(|y| exr.bits["cost"][y * 13 + 4..y * 13 + 9].to_vec());
    assert_eq!(crop.bits["cost"], rows.collect::<Vec<_>>());
}

#[test]
fn expensive_rays_are_bright_in_the_view() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt -o a.png --view cost --colormap gray --accel none")
        .succeeded();
    run.said("a.png: 13 x 7 pixels, 13 hit, cost 0 (black) to 3 (white) (");
    let costs = folder.rendered("ball.pbrt --aov cost --accel none").bits["cost"].clone();
    let expected: Vec<u8> = costs
        .iter()
        .map(|cost| if *cost == 3 { 255 } else { 85 })
        .collect();
    assert_eq!(
        folder
            .png("a.png")
            .pixels()
            .map(|pixel| pixel.0[0])
            .collect::<Vec<_>>(),
        expected
    );
    folder
        .render("ball.pbrt -o b.png --view cost --colormap gray --accel none --range 1,2")
        .succeeded();
    let expected: Vec<u8> = costs
        .iter()
        .map(|cost| if *cost == 3 { 255 } else { 0 })
        .collect();
    assert_eq!(
        folder
            .png("b.png")
            .pixels()
            .map(|pixel| pixel.0[0])
            .collect::<Vec<_>>(),
        expected
    );
}

#[test]
fn a_cost_view_of_a_part_needs_a_range() {
    let folder = Folder::new();
    let crop = "ball.pbrt -o a.png --view cost --pixelbounds 0,5,0,5";
    folder
        .render(crop)
        .failed(2, "a cost PNG of a part of the film needs --range low,high");
    folder
        .render(&format!("{crop} --range 0,9"))
        .succeeded()
        .said("cost 0 (dark violet) to 9 (red) (");
    assert_eq!(folder.png("a.png").dimensions(), (5, 5));
}

#[test]
fn cost_comes_with_statistics_and_hits() {
    let folder = Folder::new();
    let [cost, usual] = ["--view cost", "--view hit"].map(|view| {
        let run = folder
            .render(&format!("ball.pbrt -o a.png {view} --json --accel middle"))
            .succeeded();
        run.json()[0].clone()
    });
    assert_eq!(cost["hits"], usual["hits"]);
    let per_ray = |flags: &str| {
        let run = folder
            .render(&format!(
                "ball.pbrt -o a.png --stats --accel middle {flags}"
            ))
            .succeeded();
        run.stderr
            .lines()
            .find(|line| line.starts_with("per ray"))
            .unwrap()
            .to_owned()
    };
    assert_eq!(per_ray("--view cost"), per_ray(""));
}
