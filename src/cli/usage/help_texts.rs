//! What `--help` says about each command, examples first. Manual pages indent
//! them: they fit on a terminal of 80 columns up to a width of 73.

pub(in crate::cli) const FEIMOS: &str = "\
Hit and depth images of PBRT scenes.

Examples:
  feimos render scene.pbrt -o depth.png   A picture: near is red, far is blue
  feimos render scene.pbrt -o depth.exr   Data: depth, hits and primitives
  feimos check scene.pbrt                 What it holds, and mistakes
  feimos pixel scene.pbrt 256,128         What a pixel shows, and why
  feimos compare a.exr b.exr              Whether two images are the same

`feimos COMMAND --help` explains all flags of a command, with examples.";

pub(in crate::cli) const RENDER: &str = "\
Render scenes to images.

Examples:
  feimos render scene.pbrt -o depth.png             Depth as colours
  feimos render scene.pbrt -o depth.exr             Data for programs
  feimos render scene.pbrt -o hits.png --view hit   Hits and misses
  feimos render *.pbrt -o 'out/{stem}.exr' --json   Many scenes
  feimos render scene.pbrt --cameras poses.json -o '{camera}.exr'

A scene is a .pbrt file, `-` for standard input, or a bare .ply, .obj, .stl or .off mesh, which is \
framed automatically.";

pub(in crate::cli) const CHECK: &str = "\
Check scenes without rendering them: list their content and their mistakes.

Examples:
  feimos check scene.pbrt          Content and warnings
  feimos check --strict scenes     A folder; warnings fail
  feimos check scene.pbrt --json   A line of JSON

Reads everything that rendering needs, and prints the camera, the film, shapes, bounds and \
directives. Warns of shapes that are far away, of an odd size, stretched or behind the camera, and \
of a camera that sees nothing. Casts no ray and builds no tree.";

pub(in crate::cli) const BENCH: &str = "\
Measure speed against error: how fast accelerators are built and traced, and how many answers are \
wrong.

Examples:
  feimos bench scene.pbrt                               Everything
  feimos bench scene.pbrt --accel sah,hlbvh --runs 21   Two split methods
  feimos bench scene.pbrt --report out                  A page with plots

Builds every accelerator and traces the whole image with every kernel, in turn, round after round, \
so that other load on the machine affects all of them alike. Compares the answers with exact \
arithmetic on all primitives.";

pub(in crate::cli) const COMPARE: &str = "\
Compare two images: hits, primitives, and depths in units in the last place.

Examples:
  feimos compare expected.exr found.exr               To the last bit
  feimos compare expected.exr found.exr --max-ulp 4   Allow rounding
  feimos compare a.npy b.exr --diff diff.png          A picture of errors

A is the expected image, B the image to test. Reads EXR files with any of feimos's channels, NPY \
and PFM files, and PNG files of 16-bit depths. Two misses are equal, whatever their depths. Exits \
with code 1 if more pixels differ than allowed.";

pub(in crate::cli) const PIXEL: &str = "\
Explain one pixel: its ray, what it hits, where that is in the scene file, and how close it was.

Examples:
  feimos pixel scene.pbrt 256,128               Column 256, row 128
  feimos pixel scene.pbrt 256,128 --json        The same as JSON
  feimos pixel scene.pbrt 256,128 --accel sah   Its cost in one tree

Prints the answer of each precision, the cost with each accelerator, and the result of exact \
arithmetic on every primitive.";

pub(in crate::cli) const TREE: &str = "\
Show the tree of a scene: nodes, leaves and surface areas by depth, sizes of leaves, the SAH cost, \
and pictures of its boxes.

Examples:
  feimos tree scene.pbrt                            Its figures
  feimos tree scene.pbrt --accel hlbvh --json       Those of a method
  feimos tree scene.pbrt -o boxes.png --depth 3,6   A picture of boxes

Objects of instances have trees of their own, each shown once. Pictures and meshes show the boxes \
around primitives in no instance, and around instances.";

pub(in crate::cli) const MERGE: &str = "\
Merge crops of one film: into the file that one process would have written, byte for byte.

Examples:
  feimos merge left.exr right.exr -o whole.exr      All crops of a film
  feimos merge tiles/*.exr -o whole.exr --partial   Those so far

The data window of each crop gives its position. Missing pixels are an error, and so are crops that \
differ where they overlap or that come from other films, scenes or options.";

pub(in crate::cli) const COMPLETIONS: &str = "\
Print a completion script for a shell.

Examples:
  feimos completions bash > feimos.bash   Then: source feimos.bash
  feimos completions zsh > ~/.zfunc/_feimos
  feimos completions fish > ~/.config/fish/completions/feimos.fish";

pub(in crate::cli) const MAN: &str = "\
Write the manual: a page for feimos and one for each command.

Examples:
  feimos man ~/.local/share/man/man1   Then: man feimos-render";
