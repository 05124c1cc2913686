//! Kinds of inputs: mesh files of each format, folders, and files of other programs.

use crate::folder::Folder;

#[test]
fn a_folder_is_answered_with_the_scenes_in_it() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("scenes")).unwrap();
    let empty = "scenes: this is a folder, not a file\n   = it has no file `*.pbrt`";
    folder.render("scenes").failed(66, empty);
    let folder = folder.with("scenes/a.pbrt", "WorldBegin\n");
    let advice = "this is a folder, not a file\n   = name the scenes in it: `scenes/*.pbrt`";
    folder.render("scenes").failed(66, advice);
    folder.bench("scenes").failed(66, advice);
    folder.pixel("scenes 1,1").failed(66, advice);
}
