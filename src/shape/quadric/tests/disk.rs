//! Rims and sectors of disks.

use super::*;

#[test]
fn the_rims_of_a_disk_belong_to_it() {
    let ring = disk(2.0, 0.5, 360.0);
    assert_eq!(intersect(&ring, &along_z(1.0, 0.0, 0.0)), Some(2.0));
    assert_eq!(
        intersect(&ring, &along_z(-0.6, 0.8, 0.0)),
        None,
        "6/10 and 8/10 in binary are a little more than 1 away"
    );
    assert_eq!(intersect(&ring, &along_z(0.0, -0.5, -1.0)), Some(3.0));
    assert_eq!(
        intersect(&ring, &along_z(0.0, 0.5f64.next_down(), 0.0)),
        None
    );
    assert_eq!(intersect(&ring, &along_z(1.0f64.next_up(), 0.0, 0.0)), None);
    assert_eq!(
        intersect(&ring, &along_z(0.75, 0.0, 2.0)),
        None,
        "from the plane"
    );
    assert_eq!(intersect(&ring, &along_z(0.75, 0.0, 3.0)), None, "behind");
    assert_eq!(
        intersect(&ring, &along_x(-5.0, 0.0, 2.0)),
        None,
        "in the plane"
    );
    let circle = disk(0.0, 1.0, 360.0);
    assert_eq!(intersect(&circle, &along_z(0.0, 1.0, -1.0)), Some(1.0));
    assert_eq!(
        intersect(&circle, &along_z(0.0, 1.0f64.next_down(), -1.0)),
        None
    );
}

#[test]
fn a_sector_of_a_disk_holds_both_ends_and_the_middle() {
    let part = disk(0.0, 0.0, 270.0);
    for (x, y, is_there) in [
        (0.0, 0.0, true),
        (0.5, 0.0, true),
        (0.0, -0.5, true),
        (1e-300, -0.5, false),
        (0.5, -1e-300, false),
    ] {
        assert_eq!(
            intersect(&part, &along_z(x, y, -1.0)).is_some(),
            is_there,
            "{x} {y}"
        );
    }
    let mirrored = Quadric {
        world_from_object: Matrix::scale([1.0, -1.0, 1.0]),
        ..part
    };
    assert_eq!(intersect(&mirrored, &along_z(0.5, 1e-300, -1.0)), None);
    assert_eq!(intersect(&mirrored, &along_z(0.5, -0.5, -1.0)), Some(1.0));
}
