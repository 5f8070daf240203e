//! `derive intervals`: the formulas over numbers of any kind, of every mechanism of the gallery.
//!
//! ```text
//! INTERVALS=3000 cargo test --release --all-features --test enclosures intervals -- --nocapture    poses of each mechanism
//! ```

mod cuts;
mod doubles;
mod duals;
mod enclosures;
mod facts;
mod formulas;
mod functions;
mod published;
mod sampled;
mod velocities;
mod wheels;

use linkage_gallery::all_mechanisms;

/// Poses of each mechanism.
fn poses() -> usize {
    std::env::var("INTERVALS").ok().and_then(|count| count.parse().ok()).unwrap_or(4)
}

macro_rules! tests {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        mod $file {
            use linkage_gallery::$file::{$($Mechanism),+};

            #[test]
            fn doubles_are_those_of_a_position() {
                $(super::doubles::are_those_of_a_position::<$Mechanism>();)+
            }
            #[test]
            fn derivatives_are_dual_numbers() {
                $(super::duals::are_the_derivatives::<$Mechanism>();)+
            }
            #[test]
            fn points_are_enclosed() {
                $(super::enclosures::of_points::<$Mechanism>();)+
            }
            #[test]
            fn boxes_are_enclosed() {
                $(super::enclosures::of_boxes::<$Mechanism>();)+
            }
            #[test]
            fn velocities_at_points_are_enclosed() {
                $(super::velocities::of_points::<$Mechanism>();)+
            }
            #[test]
            fn velocities_over_boxes_are_enclosed() {
                $(super::velocities::of_boxes::<$Mechanism>();)+
            }
            tests!(@ $($orders)? $($Mechanism)+);
            #[test]
            fn turns_leave_the_residual() {
                $(super::facts::turns_leave_the_residual::<$Mechanism>();)+
            }
        }
    )*};
    (@ orders $Mechanism:ident) => {
        #[test]
        fn sensitivities_are_enclosed() {
            super::velocities::of_sensitivities::<$Mechanism>();
        }
    };
    (@ $($Mechanism:ident)+) => {};
}

all_mechanisms!(tests);
