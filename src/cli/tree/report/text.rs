//! The report on trees as text: one screen, with bars.

use super::{LeafSize, Report, Tree, TreeLevel};
use crate::cli::terminal::words::{counted, line, lines, short};
use crate::error::{grouped, printable};
use std::fmt::{self, Display, Formatter};

/// The most rows of a table of depths; deeper trees have several depths a row.
const MOST_ROWS: usize = 24;

/// The most objects that are listed.
const MOST_OBJECTS: usize = 10;

/// The width of the longest bar.
const BAR: usize = 30;

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}, {}", printable(&self.scene), self.accel)?;
        let nodes = counted(self.nodes as u64, "node");
        let leaves = grouped(self.leaves as u64);
        line(f, "all trees", &format!("{nodes}, {leaves} of them leaves"))?;
        line(f, "depth", &self.depth.to_string())?;
        line(f, "SAH cost", &short(self.sah_cost))?;
        line(f, "memory", &counted(self.bytes as u64, "byte"))?;
        if self.never_hit > 0 {
            line(f, "never hit", &counted(self.never_hit as u64, "primitive"))?;
        }
        if self.trees.is_empty() {
            return line(f, "no tree", "nothing can be hit");
        }
        let (objects, trees): (Vec<&Tree>, Vec<&Tree>) =
            self.trees.iter().partition(|tree| tree.object.is_some());
        trees.iter().try_for_each(|tree| tree.write(f))?;
        match &objects[..] {
            [] => Ok(()),
            [object] => object.write(f),
            objects => lines(f, "objects", object_table(objects)),
        }
    }
}

impl Tree {
    /// What its leaves hold.
    fn items(&self) -> &'static str {
        match self.over {
            "instances" => "instance",
            _ => "primitive",
        }
    }

    fn write(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let items = counted(self.items as u64, self.items());
        let mean = self.items as f64 / self.leaves as f64;
        let of = match self.instances {
            Some(instances) => format!(", shown by {}", counted(instances as u64, "instance")),
            None => String::new(),
        };
        let nodes = counted(self.nodes as u64, "node");
        let cost = short(self.sah_cost);
        let text = format!("{items}{of}: {nodes}, {mean:.1} a leaf, SAH cost {cost}");
        writeln!(f)?;
        line(f, self.over, &text)?;
        lines(f, "by depth", self.depth_table())?;
        lines(f, "by leaf", self.leaf_table())
    }

    /// A row for each depth, or for several.
    fn depth_table(&self) -> Vec<String> {
        let together = self.levels.len().div_ceil(MOST_ROWS);
        let rows: Vec<Row> = self.levels.chunks(together).map(Row::of).collect();
        let most = rows.iter().map(|row| row.items).max().unwrap_or(0);
        let title = format!(
            "{:>7}  {:>9}  {:>9}  {:>11}  {:>8}",
            "depth",
            "nodes",
            "leaves",
            format!("{}s", self.items()),
            "area",
        );
        let row = |row: &Row| {
            let [nodes, leaves, items] =
                [row.nodes, row.leaves, row.items].map(|count| grouped(count as u64));
            let [nodes, leaves, items] = [nodes, leaves, items].map(|count| count.to_string());
            let bar = bar(row.items, most);
            let (depths, area) = (&row.depths, row.area);
            let text =
                format!("{depths:>7}  {nodes:>9}  {leaves:>9}  {items:>11}  {area:>8.2}  {bar}");
            text.trim_end().to_owned()
        };
        std::iter::once(title).chain(rows.iter().map(row)).collect()
    }

    /// A row for each range of leaf sizes, which double.
    fn leaf_table(&self) -> Vec<String> {
        let mut rows: Vec<(String, usize)> = Vec::new();
        let mut first = 1;
        while let Some(largest) = self.leaf_sizes.last().map(|size| size.items)
            && first <= largest
        {
            // 1, 2, 3-4, 5-8, 9-16, ...
            let last = first.checked_next_power_of_two().unwrap_or(u32::MAX);
            let within = |size: &&LeafSize| (first..=last).contains(&size.items);
            let leaves = self.leaf_sizes.iter().filter(within);
            let name = if first == last {
                first.to_string()
            } else {
                format!("{first}-{last}")
            };
            rows.push((name, leaves.map(|size| size.leaves).sum()));
            let Some(next) = last.checked_add(1) else {
                break;
            };
            first = next;
        }
        let most = rows.iter().map(|(_, leaves)| *leaves).max().unwrap_or(0);
        let title = format!("{:>20}  {:>9}", format!("{}s", self.items()), "leaves");
        let row = |(name, leaves): &(String, usize)| {
            let count = grouped(*leaves as u64);
            let text = format!("{name:>20}  {count:>9}  {}", bar(*leaves, most));
            text.trim_end().to_owned()
        };
        std::iter::once(title).chain(rows.iter().map(row)).collect()
    }
}

/// A row of a table of depths.
struct Row {
    depths: String,
    nodes: usize,
    leaves: usize,
    items: usize,
    area: f64,
}

impl Row {
    fn of(levels: &[TreeLevel]) -> Row {
        let depths = match levels {
            [first, .., last] => format!("{}-{}", first.depth, last.depth),
            [level] => level.depth.to_string(),
            [] => String::new(),
        };
        let sum = |of: fn(&TreeLevel) -> usize| levels.iter().map(of).sum();
        Row {
            depths,
            nodes: sum(|level| level.nodes),
            leaves: sum(|level| level.leaves),
            items: sum(|level| level.items),
            area: levels.iter().map(|level| level.area).sum(),
        }
    }
}

/// A row for each of the objects with the most primitives in all.
fn object_table(objects: &[&Tree]) -> Vec<String> {
    let mut sorted = objects.to_vec();
    let all = |tree: &Tree| tree.items as u64 * tree.instances.unwrap_or(0) as u64;
    sorted.sort_by_key(|tree| std::cmp::Reverse(all(tree)));
    let title = format!(
        "{:>7}  {:>9}  {:>11}  {:>9}  {:>5}  {:>8}",
        "object", "instances", "primitives", "nodes", "depth", "SAH cost"
    );
    let row = |tree: &&Tree| {
        let counts = [tree.instances.unwrap_or(0), tree.items, tree.nodes];
        let [instances, items, nodes] = counts.map(|count| grouped(count as u64));
        format!(
            "{:>7}  {instances:>9}  {items:>11}  {nodes:>9}  {:>5}  {:>8}",
            tree.object.unwrap_or(0),
            tree.depth,
            short(tree.sah_cost),
        )
    };
    let mut rows = vec![title];
    rows.extend(sorted.iter().take(MOST_OBJECTS).map(row));
    if let Some(more @ 1..) = sorted.len().checked_sub(MOST_OBJECTS) {
        rows.push(format!("and {} more; --json has all", grouped(more as u64)));
    }
    rows
}

/// A bar for `count`, where the longest stands for `most`. A count above 0 has a mark.
fn bar(count: usize, most: usize) -> String {
    let length = (count as f64 / most.max(1) as f64 * BAR as f64).round() as usize;
    "#".repeat(length.max(usize::from(count > 0)))
}
