//! Modules, their files, and where a path leads.

use crate::imports::{Import, Kind, code_of, imports_of};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module that is a file.
struct Module {
    file: String,
    imports: Vec<Import>,
}

/// All modules of a folder by their paths; that of the library's root is empty.
pub(crate) struct ModuleTree(BTreeMap<Vec<String>, Module>);

/// Deeper chains of `pub use` would be a circle.
const MOST_STEPS: usize = 20;

impl ModuleTree {
    pub(crate) fn read(root: &str) -> ModuleTree {
        let mut modules = BTreeMap::new();
        read_folder(Path::new(root), &[], &mut modules);
        ModuleTree(modules)
    }

    pub(crate) fn files(&self) -> Vec<String> {
        self.0.values().map(|module| module.file.clone()).collect()
    }

    /// The files that define what `file` names.
    pub(crate) fn targets_of(&self, file: &str) -> BTreeSet<String> {
        let (at, module) = self
            .0
            .iter()
            .find(|(_, module)| module.file == file)
            .expect("a file of the tree");
        // A `pub use` hands a name on; the module needs it only where it names it, too.
        let named = module
            .imports
            .iter()
            .filter(|import| import.kind != Kind::PublicUse);
        let files = named.filter_map(|import| self.resolve(at, &import.path, MOST_STEPS));
        files.filter(|target| target != file).collect()
    }

    /// The file that defines `path` as seen from module `at`, if it belongs to the tree.
    fn resolve(&self, at: &[String], path: &[String], steps: usize) -> Option<String> {
        let steps = steps.checked_sub(1)?;
        let (first, mut rest) = path.split_first()?;
        let mut module = match first.as_str() {
            "crate" => Vec::new(),
            "feimos" if !rest.is_empty() => Vec::new(),
            "self" => at.to_vec(),
            "super" => at[..at.len().checked_sub(1)?].to_vec(),
            name => return self.resolve_name(at, name, rest, steps),
        };
        while let Some((next, behind)) = rest.split_first() {
            match next.as_str() {
                "super" => drop(module.pop()?),
                name => return self.resolve_in(&module, name, behind, steps),
            }
            rest = behind;
        }
        Some(self.0[&module].file.clone())
    }

    /// A path that begins with a name of module `at`: a child, or something imported.
    fn resolve_name(
        &self,
        at: &[String],
        name: &str,
        rest: &[String],
        steps: usize,
    ) -> Option<String> {
        let child: Vec<String> = at.iter().cloned().chain([name.to_owned()]).collect();
        let is_known = self.0.contains_key(&child) || self.import(at, name).is_some();
        is_known
            .then(|| self.resolve_in(at, name, rest, steps))
            .flatten()
    }

    /// `name` and what follows it, in `module`.
    fn resolve_in(
        &self,
        module: &[String],
        name: &str,
        rest: &[String],
        steps: usize,
    ) -> Option<String> {
        let child: Vec<String> = module.iter().cloned().chain([name.to_owned()]).collect();
        if self.0.contains_key(&child) {
            return match rest.split_first() {
                Some((next, behind)) => self.resolve_in(&child, next, behind, steps),
                None => Some(self.0[&child].file.clone()),
            };
        }
        match self.import(module, name) {
            Some(import) => {
                let whole: Vec<String> = import.path.iter().chain(rest).cloned().collect();
                self.resolve(module, &whole, steps)
            }
            None => self.0.get(module).map(|module| module.file.clone()),
        }
    }

    fn import(&self, module: &[String], name: &str) -> Option<&Import> {
        let imports = &self.0.get(module)?.imports;
        imports.iter().find(|import| {
            import.kind != Kind::Direct && import.name == name && import.path != [name]
        })
    }
}

fn read_folder(folder: &Path, at: &[String], modules: &mut BTreeMap<Vec<String>, Module>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let child: Vec<String> = at.iter().cloned().chain([name.clone()]).collect();
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            read_folder(&path, &child, modules);
            continue;
        }
        let module = match name.as_str() {
            "mod" | "lib" => at.to_vec(),
            _ => child,
        };
        let imports = imports_of(&code_of(&fs::read_to_string(&path).unwrap()));
        modules.insert(
            module,
            Module {
                file: path.to_str().unwrap().to_owned(),
                imports,
            },
        );
    }
}
