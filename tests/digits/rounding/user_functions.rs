//! User functions carry their bound through, give their own, or say that they have none.

use linkage::{Real, linkage};
use linkage_rounding::Rounded;

/// Generic: each operation has its bound.
fn generic<T: Real>(x: T) -> (T, T, T) {
    (
        x * x / linkage::real(3.0),
        x * linkage::real(2.0) / linkage::real(3.0),
        linkage::real::<T>(2.0) / linkage::real(3.0),
    )
}

/// A law that is known in doubles only, for instance from a table.
trait Tabled: Real {
    fn tabled(self) -> (Self, Self, Self);
}

impl Tabled for f64 {
    fn tabled(self) -> (f64, f64, f64) {
        (self * self / 3.0, self * 2.0 / 3.0, 2.0 / 3.0)
    }
}

impl Tabled for Rounded {
    fn tabled(self) -> (Self, Self, Self) {
        let (law, slope, bend) = self.value().tabled();
        (Self::unknown(law), Self::with_error(slope, 1e-9), Self::from(bend))
    }
}

linkage! {
    mechanism Bead {
        input x;
        unknown height, shade;
        extern fn generic(x) -> (wire, slope, bend);
        equation height = wire(x);
        equation shade = 2 * x;
    }
}

#[test]
fn a_generic_function_has_a_bound() {
    let x = Rounded::from(0.7);
    let bead = Bead::<Rounded>::new();
    let found = bead.kinematics(x, BeadBranch::default(), Rounded::from(1.0), Rounded::from(0.0)).unwrap();
    let height = found.pose.coordinates().height;
    assert!(height.error() > 0.0 && height.ulps() < 2.0, "{height:?}");
    assert!(found.rates.height.ulps() < 2.0 && found.pose.coordinates().shade.error() == 0.0);
    // A measured input.
    let measured = Rounded::with_error(0.7, 1e-3);
    let height = bead.assemble(measured, BeadBranch::default()).unwrap().coordinates().height;
    assert!((0.7 * 2.0 / 3.0 * 1e-3..0.475e-3).contains(&height.error()), "{height:?}");
}

#[test]
fn a_function_in_doubles_gives_what_it_knows() {
    let (law, slope, bend) = Rounded::from(0.7).tabled();
    assert_eq!((law.error(), slope.error(), bend.error()), (f64::INFINITY, 1e-9, 0.0));
}
