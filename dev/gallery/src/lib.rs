//! The mechanisms that the tests, examples and benches share, compiled once.
//!
//! To add a mechanism, write `src/mechanisms/<file>.rs` with one `linkage!` and add one line to [`all_mechanisms!`].
//! Every general test then takes it: see `tests/README.md`.

pub mod andrews_motion;
pub mod cam_laws;
pub mod car_axis_motion;
pub mod checks;
pub mod families;
mod fixture;
pub mod listed;
pub mod source;

pub use fixture::{Fixture, named};

/// Calls a macro with the list of all mechanisms.
///
/// A line is a file of `src/mechanisms` and its mechanism, or one name for each driver. After the name stands how a
/// position is found: `closed` form or `newton`, or that the mechanism is an `open` chain. A line ends in `orders` if the file derives jerk, the derivatives of the
/// velocity ratios and sensitivities.
///
/// ```
/// macro_rules! names {
///     ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => { [$($(stringify!($Mechanism)),+),*] };
/// }
/// assert!(linkage_gallery::all_mechanisms!(names).contains(&"FourBar"));
/// ```
#[macro_export]
macro_rules! all_mechanisms {
    ($callback:ident) => {
        $callback! {
            andrews: Andrews closed;
            andrews_scene: Squeezer closed;
            belt: Belt closed;
            block: Block closed;
            cam_follower: CamFollower closed;
            cam_rocker: CamRocker closed;
            car_axis: CarAxis open;
            cardan: Cardan closed;
            cart_pendulum: CartPendulum open, orders;
            chebyshev: ChebyshevRocker closed ChebyshevCoupler closed;
            components: Components closed, orders;
            coupled_wheels: CoupledWheels closed;
            crank_shaper: CrankShaper closed;
            distances: Distances closed, orders;
            double_butterfly: DoubleButterfly newton, orders;
            double_pendulum: DoublePendulum open, orders;
            drag_link_drive: DragLinkDrive closed;
            elliptic_trammel: EllipticTrammel closed, orders;
            every_function: EveryFunction closed, orders;
            five_bar: FiveBar closed, orders;
            five_bar_contacts: Pair closed;
            five_bar_scenes: Pair closed;
            five_windows: FiveWindows closed;
            four_bar: FourBar closed;
            four_bar_effects: FourBar closed;
            four_bar_scenes: LoadedFourBar closed;
            gate: Gate closed;
            geared_five_bar: GearedFiveBar closed, orders;
            geneva: Geneva closed;
            hart: Hart closed;
            hoecken: Hoecken closed;
            implied_loops: ImpliedLoops closed, orders;
            introductory: Introductory closed;
            inverted_slider_crank: InvertedSliderCrank closed;
            jansen: Jansen closed, orders;
            joint_coordinates: JointCoordinates closed, orders;
            klann: Klann closed;
            klann_mirrored: KlannMirrored closed, orders;
            mirrored_angles: MirroredAngles closed, orders;
            multiples: Multiples closed;
            norton_four_bar: NortonFourBar closed, orders;
            offset_slider_crank: OffsetSliderCrank closed, orders;
            one_window: OneWindow closed;
            pantograph: Pantograph closed;
            peaucellier: Peaucellier closed;
            pendulum: Pendulum open, orders;
            pin_and_slot: PinAndSlot closed;
            rack_steering: RackSteering closed, orders;
            roberts: Roberts closed;
            rpr: Rpr closed;
            rrr: Rrr closed;
            scissor_lift: ScissorLift closed, orders;
            scotch_yoke: ScotchYoke closed;
            six_bar: SixBar closed;
            slider_crank: Engine closed Compressor closed;
            slider_crank_contacts: Machine closed;
            slider_crank_scenes: Crank closed Piston closed;
            slider_named_first: SliderNamedFirst closed;
            slider_triad: SliderTriadNear closed SliderTriadFar newton;
            slotted_lever: SlottedLever closed;
            sprocket_strand: SprocketStrand closed;
            stephenson_far: StephensonFar newton;
            stephenson_i: StephensonI closed;
            stephenson_ii: StephensonII newton;
            stephenson_iii: StephensonIII closed;
            swivel_triad: SwivelTriadNear closed SwivelTriadFar newton;
            three_link_arm: ThreeLinkArm open, orders;
            three_rrr: ThreeRrr newton;
            three_together: ThreeTogether newton;
            tilted_parallelogram: TiltedParallelogram closed;
            two_triads: TwoTriads newton;
            two_windows: TwoWindows closed;
            v_twin: VTwin closed;
            watt_i: WattI closed;
            watt_ii: WattII closed;
            watt_line: WattLine closed;
            whitworth: Whitworth closed;
            wiper: Wiper closed;
            yoke: Yoke closed;
        }
    };
}

macro_rules! modules {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        mod mechanisms {
            $(pub mod $file;)*
        }
        pub use mechanisms::{$($file),*};

        /// The files of all mechanisms, without their endings.
        pub const FILES: &[&str] = &[$(stringify!($file)),*];

        /// The text of each.
        const TEXTS: &[&str] = &[$(include_str!(concat!("mechanisms/", stringify!($file), ".rs"))),*];
    };
}

all_mechanisms!(modules);

mod implementations {
    use linkage::derivation::Derivation;
    use linkage::{Mechanism, PositionError, Real};
    use nalgebra::DMatrix;

    use super::*;
    use crate::fixture::{array, by_name, column, fixtures, inputs, list, matrices, matrix, pairs};
    use crate::listed::{At, PosedWithOrders};

    all_mechanisms!(fixtures);
}
