//! The forms of the quadrics that are not whole spheres.

use crate::digest::Digester;
use crate::shape::{Cut, Disk, Form, Hyperboloid, Revolved, Sector};

/// Forms by the indices of their quadrics, in order. Large ones have tables of their own, so that
/// they make no other form larger.
#[derive(Debug, Default)]
pub(super) struct Forms {
    stored: Vec<(u32, StoredForm)>,
    hyperboloids: Vec<Hyperboloid>,
}

/// A form, or its index in a table.
#[derive(Debug, Clone, Copy)]
enum StoredForm {
    Sphere(Cut),
    Cylinder(Cut),
    Disk(Disk),
    Cone(Cut),
    Paraboloid(Cut),
    Hyperboloid(u32),
    Patch,
}

impl Forms {
    /// Adds the form of a quadric that comes after all others.
    pub(super) fn push(&mut self, quadric: u32, form: Form) {
        let stored = match form {
            Form::Sphere(None) => return,
            Form::Sphere(Some(cut)) => StoredForm::Sphere(cut),
            Form::Cylinder(cut) => StoredForm::Cylinder(cut),
            Form::Disk(disk) => StoredForm::Disk(disk),
            Form::Revolved(Revolved::Cone(cut)) => StoredForm::Cone(cut),
            Form::Revolved(Revolved::Paraboloid(cut)) => StoredForm::Paraboloid(cut),
            Form::Revolved(Revolved::Hyperboloid(hyperboloid)) => {
                self.hyperboloids.push(hyperboloid);
                StoredForm::Hyperboloid(self.hyperboloids.len() as u32 - 1)
            }
            Form::Patch => StoredForm::Patch,
        };
        self.stored.push((quadric, stored));
    }

    /// The form of one of `count` quadrics.
    #[inline]
    pub(super) fn of(&self, quadric: usize, count: usize) -> Form {
        // As many places before it are missing as whole spheres come before it.
        let spheres = count - self.stored.len();
        let first = quadric.saturating_sub(spheres).min(self.stored.len());
        let last = (quadric + 1).min(self.stored.len());
        let near = &self.stored[first..last];
        let place = near.binary_search_by_key(&quadric, |(stored, _)| *stored as usize);
        let Ok(place) = place else {
            return Form::Sphere(None);
        };
        match near[place].1 {
            StoredForm::Sphere(cut) => Form::Sphere(Some(cut)),
            StoredForm::Cylinder(cut) => Form::Cylinder(cut),
            StoredForm::Disk(disk) => Form::Disk(disk),
            StoredForm::Cone(cut) => Form::Revolved(Revolved::Cone(cut)),
            StoredForm::Paraboloid(cut) => Form::Revolved(Revolved::Paraboloid(cut)),
            StoredForm::Hyperboloid(index) => {
                Form::Revolved(Revolved::Hyperboloid(self.hyperboloids[index as usize]))
            }
            StoredForm::Patch => Form::Patch,
        }
    }

    /// The memory of the tables in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.stored[..]) + size_of_val(&self.hyperboloids[..])
    }

    /// Adds everything that pictures depend on. Tables that are empty add nothing.
    pub(super) fn digest(&self, digester: &mut Digester) {
        digester.list(&self.stored, |(quadric, form)| words_of(*quadric, form));
        if !self.hyperboloids.is_empty() {
            digester.list(&self.hyperboloids, |hyperboloid| {
                let ([a, b, c], [d, e, f]) = (hyperboloid.p1, hyperboloid.p2);
                [a, b, c, d, e, f, degrees(hyperboloid.sector)].map(f64::to_bits)
            });
        }
    }
}

fn degrees(sector: Option<Sector>) -> f64 {
    sector.map_or(360.0, |sector| sector.degrees)
}

/// The index and kind of a form, and its numbers.
fn words_of(place: u32, form: &StoredForm) -> [u64; 4] {
    let words = |kind: u64, a: f64, b: f64, sector: Option<Sector>| {
        let kind = u64::from(place) << 32 | kind;
        [kind, a.to_bits(), b.to_bits(), degrees(sector).to_bits()]
    };
    let of_cut = |kind: u64, cut: &Cut| words(kind, cut.z_min, cut.z_max, cut.sector);
    match form {
        StoredForm::Sphere(cut) => of_cut(1, cut),
        StoredForm::Cylinder(cut) => of_cut(2, cut),
        StoredForm::Disk(Disk {
            height,
            inner_radius,
            sector,
            has_negative_radius,
        }) => words(
            3 + u64::from(*has_negative_radius),
            *height,
            *inner_radius,
            *sector,
        ),
        StoredForm::Cone(cut) => of_cut(5, cut),
        StoredForm::Paraboloid(cut) => of_cut(6, cut),
        StoredForm::Hyperboloid(_) => words(7, 0.0, 0.0, None),
        StoredForm::Patch => words(8, 0.0, 0.0, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_come_back_and_are_as_small_as_a_disk() {
        assert_eq!(size_of::<StoredForm>(), size_of::<Disk>());
        assert_eq!(size_of::<(u32, StoredForm)>(), 64);
        let hyperboloid = |x: f64| Revolved::hyperboloid([x, 0.0, 0.5], [1.0, 1.0, 1.0], 90.0);
        let forms = [
            Form::Sphere(None),
            Form::Sphere(Cut::new(1.0, 0.0, 1.0, 30.0)),
            Form::Revolved(hyperboloid(2.0)),
            Form::Cylinder(Cut::of_cylinder(0.0, 1.0, 360.0)),
            Form::Sphere(None),
            Form::Patch,
            Form::Disk(Disk::new(1.0, 0.5, 360.0)),
            Form::Revolved(Revolved::cone(2.0, 45.0)),
            Form::Revolved(hyperboloid(3.0)),
            Form::Revolved(Revolved::paraboloid(2.0, 0.0, 45.0)),
        ];
        let mut table = Forms::default();
        for (form, index) in forms.iter().zip(0..) {
            table.push(index, *form);
        }
        for (form, index) in forms.iter().zip(0usize..) {
            assert_eq!(table.of(index, forms.len()), *form);
        }
    }

    #[test]
    fn every_number_of_a_form_is_in_the_digest() {
        let line = |x: f64, z: f64, phi: f64| {
            Form::Revolved(Revolved::hyperboloid([1.0, x, 0.5], [1.0, 1.0, z], phi))
        };
        let forms = [
            Form::Sphere(Cut::new(1.0, 0.0, 1.0, 30.0)),
            Form::Cylinder(Cut::of_cylinder(0.0, 1.0, 30.0)),
            Form::Revolved(Revolved::cone(1.0, 30.0)),
            Form::Revolved(Revolved::cone(1.0, 31.0)),
            Form::Revolved(Revolved::cone(2.0, 30.0)),
            Form::Revolved(Revolved::paraboloid(0.0, 1.0, 30.0)),
            Form::Revolved(Revolved::paraboloid(0.5, 1.0, 30.0)),
            line(0.0, 1.0, 30.0),
            line(0.5, 1.0, 30.0),
            line(0.0, 2.0, 30.0),
            line(0.0, 1.0, 60.0),
            Form::Patch,
        ];
        let digests = forms.map(|form| {
            let (mut table, mut digester) = (Forms::default(), Digester::default());
            table.push(0, form);
            table.digest(&mut digester);
            digester.finish().to_string()
        });
        let different: std::collections::BTreeSet<&String> = digests.iter().collect();
        assert_eq!(different.len(), digests.len());
    }
}
