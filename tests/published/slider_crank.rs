//! The rigid slider-crank of problem "crank" of the Test Set for IVP Solvers (F. Mazzia, C. Magherini, release 2.4,
//! 2008), after B. Simeon, "Modelling a flexible slider crank mechanism by a mixed system of DAEs and PDEs", Math.
//! Modelling Syst. 2 (1996): its dimensions and masses, at the crank's constant speed.

use linkage::nalgebra::{Vector2, vector};
use linkage::{Mechanism, Slider, linkage};
use linkage_oracle::close;

linkage! {
    mechanism SliderCrank {
        param r = 0.15, l = 0.3;
        param m2 = 0.151104, j2 = 1.133281481e-3, m3 = 0.075552, omega = 150;
        coordinate theta, psi, x;
        loop r@theta + l@psi = (x, 0);
        drive Crank by theta;
        drive Block by x;

        body rod { mass m2; inertia j2; center r@theta + (l/2)@psi; angle psi; }
        body block { mass m3; center (x, 0); }

        /// The crank's inertia has no part in it.
        scene Steady of Crank {
            inertia;
            drive theta = omega * t;
            energy;
            power;
            reactions;
        }
    }
}

/// psi, x, psi', x', psi'', x'' every 15 degrees of the crank, and the determinant of the mechanism driven by its
/// block: closed form, with 40 digits. The second half of the turn mirrors the first.
#[rustfmt::skip] // A row in two lines.
const ROWS: [[f64; 7]; 13] = [
    [0.0, 0.45, -75.0, 0.0,
        0.0, -5062.5, 0.0],
    [-0.129_773_471_786_593_2, 0.442_366_244_162_634_15, -73.058_771_077_222_3, -8.659_778_719_792_268,
        2_239.814_129_084_854_4, -4_760.854_141_570_745, -0.017_173_921_334_964_228],
    [-0.252_680_255_142_078_65, 0.420_377_561_533_222_1, -67.082_039_324_993_69, -16.281_152_949_374_526,
        4_647.580_015_448_901, -3_881.399_115_958_816_3, -0.031_528_317_114_991_655],
    [-0.361_367_123_906_707_83, 0.386_690_321_186_027_75, -56.694_670_951_384_08, -21.923_280_519_726_87,
        7_289.314_836_606_525, -2_515.343_485_283_802_7, -0.041_014_702_249_476_64],
    [-0.447_832_396_928_932_5, 0.345_416_345_659_799_2, -41.602_514_716_892_19, -24.889_896_776_071_56,
        9_977.215_737_086_199, -859.449_947_461_857_5, -0.044_870_899_533_565_926],
    [-0.504_035_275_597_108_4, 0.301_515_099_146_886_35, -22.168_254_616_173_04, -24.945_264_540_131_046,
        12_138.907_020_311_419, 756.183_045_799_746_7, -0.043_686_183_192_312_98],
    [-std::f64::consts::FRAC_PI_6, 0.259_807_621_135_331_57, 0.0, -22.5,
        12_990.381_056_766_58, 1_948.557_158_514_987, -0.038_971_143_170_299_74],
    [-0.504_035_275_597_108_4, 0.223_869_385_616_130_1, 22.168_254_616_173_04, -18.521_397_642_877_027,
        12_138.907_020_311_419, 2_503.211_600_241_762, -0.032_436_183_192_312_98],
    [-0.447_832_396_928_932_5, 0.195_416_345_659_799_2, 41.602_514_716_892_19, -14.081_246_394_228_18,
        9_977.215_737_086_199, 2_515.550_052_538_142_6, -0.025_385_327_948_416_057],
    [-0.361_367_123_906_707_83, 0.174_558_286_830_063_47, 56.694_670_951_384_08, -9.896_524_633_667_77,
        7_289.314_836_606_525, 2_257.627_287_725_393, -0.018_514_702_249_476_645],
    [-0.252_680_255_142_078_65, 0.160_569_940_397_890_46, 67.082_039_324_993_69, -6.218_847_050_625_473,
        4_647.580_015_448_901, 1_964.272_359_586_144_8, -0.012_042_745_529_841_786],
    [-0.129_773_471_786_593_2, 0.152_588_496_275_913_64, 73.058_771_077_222_3, -2.987_078_309_821_166_4,
        2_239.814_129_084_854_4, 1_759.145_185_880_465_8, -0.005_923_921_334_964_227],
    [0.0, 0.15, 75.0, 0.0,
        0.0, 1687.5, 0.0],
];

/// The row at so many steps of 15 degrees.
fn row(step: usize) -> [f64; 7] {
    if step <= 12 {
        return ROWS[step];
    }
    let [psi, x, psi1, x1, psi2, x2, determinant] = ROWS[24 - step];
    [-psi, x, psi1, -x1, -psi2, x2, -determinant]
}

#[test]
fn motion_through_a_turn() {
    let crank = Crank::default();
    let block = Block::from(SliderCrank { r: crank.r, l: crank.l });
    for step in 0..=24_u32 {
        let theta = f64::from(step) * std::f64::consts::PI / 12.0;
        let [psi, x, psi1, x1, psi2, x2, determinant] = row(step as usize);
        let pose = crank.assemble(theta, CrankBranch { psi_x: Slider::Far }).unwrap();
        let q = pose.coordinates();
        close("psi", q.psi, psi, 2e-14);
        close("x", q.x, x, 2e-14 * 0.45);
        let rate = crank.velocity(&pose, 150.0).unwrap();
        close("psi'", rate.psi, psi1, 2e-14 * 75.0);
        close("x'", rate.x, x1, 2e-14 * 30.0);
        let second = crank.acceleration(&pose, &rate, 0.0).unwrap();
        close("psi''", second.psi, psi2, 2e-14 * 1.3e4);
        close("x''", second.x, x2, 2e-14 * 5e3);
        close("determinant", block.determinant(&block.pose_at(&q)), determinant, 2e-14 * 0.045);
    }
}

/// Power, the force on the block and the torque of the crank by Newton's and Euler's laws from the table alone.
#[test]
fn forces_through_a_turn() {
    let scene = Steady::default();
    let (l, omega) = (0.3, 150.0_f64);
    for step in 0..=24_u32 {
        let t = f64::from(step) * std::f64::consts::PI / 12.0 / omega;
        let theta = omega * t;
        let [psi, x, psi1, x1, psi2, x2, _] = row(step as usize);
        let q = SliderCrankCoordinates { theta, psi, x };
        // The rod's centre, seen from the block.
        let (along, across) = (vector![psi.cos(), psi.sin()], vector![-psi.sin(), psi.cos()]);
        let velocity = vector![x1, 0.0] - across * (psi1 * l / 2.0);
        let acceleration: Vector2<f64> = vector![x2, 0.0] - (across * psi2 - along * (psi1 * psi1)) * (l / 2.0);
        let kinetic = (scene.m2 * velocity.norm_squared() + scene.j2 * psi1 * psi1 + scene.m3 * x1 * x1) / 2.0;
        let power = scene.m2 * velocity.dot(&acceleration) + scene.j2 * psi1 * psi2 + scene.m3 * x1 * x2;
        close("energy", scene.energy(&q, omega).unwrap().kinetic, kinetic, 2e-14 * 80.0);
        close("power", scene.power(t, &q, omega).unwrap().applied, power, 2e-14 * 2e4);
        close("torque", scene.drive_forces(t, &q, omega).unwrap().theta, power / omega, 2e-14 * 130.0);
        // The rod on the block; what holds the rod at the other end turns it about its centre, too.
        let force = scene.reactions(t, &q, omega).unwrap().multipliers;
        close("along", force.x, scene.m3 * x2, 2e-14 * 400.0);
        // About the pin: j psi'' + m (G - P) x G'' = -(B - P) x F.
        let euler = scene.j2 * psi2 + scene.m2 * l / 2.0 * along.perp(&acceleration);
        close("moment", -l * along.perp(&force), euler, 2e-14 * 60.0);
    }
}

/// The crank's angle at this distance of the block from its dead centre: 40 digits. The rounding error of the block's
/// coordinate is the only loss.
#[test]
fn near_the_dead_centre() {
    let block = Block::from(SliderCrank::<f64> { r: 0.15, l: 0.3 });
    for (short, theta) in [
        (0.1, 1.019_479_357_663_014_f64),
        (0.01, 0.300_113_199_371_838_83),
        (1e-3, 0.094_342_131_008_507_26),
        (1e-4, 0.029_816_172_479_490_966),
        (1e-6, 0.002_981_425_902_409_385_3),
        (1e-8, 0.000_298_142_399_267_667_64),
        (1e-10, 2.981_424_507_290_666_7e-5),
    ] {
        let x: f64 = 0.45 - short;
        let pose = block.assemble(x, BlockBranch { theta_psi: linkage::Elbow::Left }).unwrap();
        let found: f64 = pose.coordinates().theta.abs();
        // d theta = dx / (2 short) theta.
        let known = 4.0 * f64::EPSILON * (1.0 + 0.45 / (2.0 * short));
        assert!((found / theta - 1.0).abs() < known, "{short}: {found} {theta} {:e} {known:e}", found / theta - 1.0);
    }
}
