//! Every value of the Maple sheet in 40-digit arithmetic, and its printed digits.
//!
//! Source: "Analisi cinematica mediante il metodo delle equazioni di vincolo", La Sapienza, 2009-2010, a
//! four-bar l = (80, 20, 50, 70) at theta2 = 20 deg, 400 rpm. The sheet's arithmetic has ten digits; the
//! references below are the same formulas in 40-digit arithmetic.

use approx::assert_relative_eq;
use linkage::analysis::{Analysis, PolarVector, Turning};
use linkage::derivation::FormulaMatrix;
use linkage::sheet::Values;
use linkage::{Document, PointMotion, position};

use linkage_gallery::four_bar::*;
use linkage_report::lend::Lender;

/// Relative error of a result against exact arithmetic.
const EXACT: f64 = 1e-13;

/// Relative error of the sheet against exact arithmetic.
const PRINTED: f64 = 1e-8;

const THETA2: f64 = 0.349_065_850_398_865_9;
const OMEGA2: f64 = 41.887_902_047_863_91;

fn start() -> FourBarCoordinates {
    FourBarCoordinates { theta2: 20_f64.to_radians(), theta3: 70_f64.to_radians(), theta4: (-50_f64).to_radians() }
}

fn solved() -> FourBarCoordinates {
    FourBar::default().solve(&start()).unwrap().coordinates
}

#[test]
fn newton_iterates() {
    let iterates = [
        [1.221_730_476_396_030_6, -0.872_664_625_997_164_8],
        [1.231_369_780_041_541_7, -0.880_815_834_058_365_9],
        [1.231_343_147_333_65, -0.880_796_908_781_316_4],
        [1.231_343_147_254_347_2, -0.880_796_908_593_408_3],
        [1.231_343_147_254_347_2, -0.880_796_908_593_408_3],
    ];
    let four_bar = FourBar::default();
    let mut q = start();
    for (step, [theta3, theta4]) in iterates.into_iter().enumerate() {
        if step > 0 {
            q = position::newton_step(&four_bar, &q).unwrap();
        }
        assert_relative_eq!(q.theta3, theta3, max_relative = EXACT);
        assert_relative_eq!(q.theta4, theta4, max_relative = EXACT);
        assert_relative_eq!(q.theta2, THETA2, max_relative = EXACT);
    }
    let solution = four_bar.solve(&start()).unwrap();
    assert_relative_eq!(solution.coordinates.theta3, iterates[4][0], max_relative = EXACT);
    assert_relative_eq!(solution.coordinates.theta4, iterates[4][1], max_relative = EXACT);
    assert!(solution.residual < 1e-15 && solution.iterations <= 5);
    assert_relative_eq!(solution.coordinates.theta3, 1.231_343_146_814_298_8, max_relative = PRINTED);
    assert_relative_eq!(solution.coordinates.theta4, -0.880_796_908_651_079_8, max_relative = PRINTED);
}

#[test]
fn ratios_velocities_accelerations() {
    let four_bar = FourBar::default();
    let pose = four_bar.pose_at(&solved());
    let ratios = four_bar.velocity_ratios(&pose).unwrap();
    assert_relative_eq!(ratios[0], -0.439_871_260_155_996, max_relative = EXACT);
    assert_relative_eq!(ratios[1], -0.257_433_739_305_082, max_relative = EXACT);
    let velocity = four_bar.velocity(&pose, OMEGA2).unwrap();
    assert_relative_eq!(velocity.theta3, -18.425_284_259_084_822, max_relative = EXACT);
    assert_relative_eq!(velocity.theta4, -10.783_359_255_826_607, max_relative = EXACT);
    assert_relative_eq!(velocity.theta3, -18.425_284_25, max_relative = PRINTED);
    assert_relative_eq!(velocity.theta4, -10.783_359_24, max_relative = PRINTED);
    let acceleration = four_bar.acceleration(&pose, &velocity, 0.0).unwrap();
    assert_relative_eq!(acceleration.theta3, -259.655_463_740_965, max_relative = EXACT);
    assert_relative_eq!(acceleration.theta4, 584.710_757_984_326_3, max_relative = EXACT);
    assert_relative_eq!(acceleration.theta3, -259.655_463_7, max_relative = PRINTED);
    assert_relative_eq!(acceleration.theta4, 584.710_757_2, max_relative = PRINTED);
}

/// Position, velocity and acceleration in exact arithmetic.
type Row = (&'static str, [f64; 2], [f64; 2], [f64; 2]);

const POINTS: [Row; 5] = [
    (
        "B",
        [18.793_852_415_718_167, 6.840_402_866_513_375],
        [-286.530_125_240_439_76, 787.235_049_091_613_2],
        [-32_975.624_624_994_82, -12_002.145_819_833_719],
    ),
    (
        "C",
        [35.442_428_654_154_64, 53.987_246_973_335_29],
        [582.163_879_346_512_1, 480.480_299_389_376],
        [-26_385.732_415_603_135, -32_330.973_572_329_072],
    ),
    (
        "G2",
        [9.396_926_207_859_083, 3.420_201_433_256_687_5],
        [-143.265_062_620_219_88, 393.617_524_545_806_6],
        [-16_487.812_312_497_41, -6_001.072_909_916_859],
    ),
    (
        "G3",
        [27.118_140_534_936_405, 30.413_824_919_924_334],
        [147.816_877_053_036_2, 633.857_674_240_494_6],
        [-29_680.678_520_298_98, -22_166.559_696_081_396],
    ),
    (
        "G4",
        [57.721_214_327_077_32, 26.993_623_486_667_644],
        [291.081_939_673_256_04, 240.240_149_694_688],
        [-13_192.866_207_801_568, -16_165.486_786_164_536],
    ),
];

/// Velocity and acceleration as the sheet prints them.
const SHEET: [(&str, [f64; 2], [f64; 2]); 3] = [
    ("G2", [-143.265_062_582_571_63, 393.617_524_561_588_5], [-16_487.812_310_063_113, -6_001.072_907_213_23]),
    ("G3", [147.816_876_851_324_48, 633.857_674_241_152_4], [-29_680.678_516_457_79, -22_166.559_682_784_482]),
    ("G4", [291.081_939_585_819_6, 240.240_150_048_553_77], [-13_192.866_189_499_306, -16_165.486_750_680_546]),
];

#[test]
fn points() {
    let motion = FourBar::default().motion(&solved(), OMEGA2, 0.0).unwrap();
    let found: [PointMotion; 5] = motion.points.into();
    for ((name, position, velocity, acceleration), (label, found)) in
        POINTS.into_iter().zip(FourBarPoints::<()>::NAMES.into_iter().zip(found))
    {
        assert_eq!(name, label);
        for axis in 0..2 {
            assert_relative_eq!(found.position[axis], position[axis], max_relative = EXACT);
            assert_relative_eq!(found.velocity[axis], velocity[axis], max_relative = EXACT);
            assert_relative_eq!(found.acceleration[axis], acceleration[axis], max_relative = EXACT);
        }
        for (_, velocity, acceleration) in SHEET.into_iter().filter(|(printed, ..)| *printed == name) {
            for axis in 0..2 {
                assert_relative_eq!(found.velocity[axis], velocity[axis], max_relative = PRINTED);
                assert_relative_eq!(found.acceleration[axis], acceleration[axis], max_relative = PRINTED);
            }
        }
    }
}

/// The derivatives of `psi_u` and `psi_v` with respect to time, H2, H3 and H0, in exact arithmetic.
const J_RATE: [[f64; 2]; 2] =
    [[306.754_749_702_237_1, 868.694_004_586_951_9], [480.480_299_389_376, -582.163_879_346_512_1]];
const A_RATE: [f64; 2] = [-787.235_049_091_613_2, -286.530_125_240_439_76];
const H: [[f64; 2]; 4] = [
    [0.0, 0.0],
    [-10_833.235_144_750_9, -9_728.251_711_918_187],
    [-32_975.624_624_994_82, -12_002.145_819_833_719],
    [-43_808.859_769_745_73, -21_730.397_531_751_903],
];

/// The determinants of J if theta2, theta3 or theta4 drives.
const DETERMINANTS: [f64; 3] = [-2_999.559_667_160_038, 1_319.420_090_706_785_7, -772.187_861_385_715_7];

/// The second half of the sheet in numbers: from J, A and gamma, and by the formulas of `derive sheet`.
#[test]
fn derivatives_of_the_jacobian_and_both_accelerations() {
    let (m, q) = (FourBar::default(), solved());
    let at = Analysis::of(&m, &m.pose_at(&q), OMEGA2, 0.0).unwrap();
    let close = |found: &[f64], exact: &[f64]| {
        assert_eq!(found.len(), exact.len());
        for (&found, &exact) in found.iter().zip(exact) {
            assert_relative_eq!(found, exact, max_relative = EXACT);
        }
    };
    let columns: Vec<f64> = J_RATE.concat();
    close(&at.jacobian_rates.unknowns.iter().copied().collect::<Vec<_>>(), &columns);
    close(&at.jacobians_of_rates.unknowns.iter().copied().collect::<Vec<_>>(), &columns);
    close(at.jacobian_rates.inputs.column(0).as_slice(), &A_RATE);
    for (found, exact) in at.terms.iter().zip(H) {
        close(found.as_slice(), &exact);
    }
    close(at.gamma_parts[0].as_slice(), &H[1]);
    close(at.gamma_parts[1].as_slice(), &H[2]);
    assert!(at.gamma_parts[2].largest() <= EXACT * at.gamma.largest());
    let alphas = [-259.655_463_740_965, 584.710_757_984_326_3];
    for found in at.accelerations {
        close(found.as_slice(), &alphas);
    }
    let choices = [[2], [0], [1]].map(|choice| at.determinant_of(&choice).unwrap());
    close(&choices, &DETERMINANTS);
    for wrong in [&[][..], &[3], &[0, 1]] {
        assert_eq!(at.determinant_of(wrong), None);
    }

    // The same by formulas.
    let mechanism = linkage_compiler::read(linkage_gallery::source::tokens_of("four_bar")).unwrap().remove(0);
    let lender = Lender::default();
    let sheet = lender.sheet(&linkage_compiler::sheets(&mechanism).unwrap()[0]).unwrap();
    let names = FourBar::<f64>::PARAMETERS.into_iter().zip(<[f64; 4]>::from(m.clone()));
    let values = Values::of::<FourBar>(FourBar::DERIVATION, names, &q, &at);
    let numbers = |matrix: &FormulaMatrix<'_>| -> Vec<f64> {
        let places = (0..matrix.columns).flat_map(|column| (0..matrix.rows).map(move |row| (row, column)));
        places
            .map(|(row, column)| matrix.entry(row, column).map_or(0.0, |entry| values.value(entry).unwrap()))
            .collect()
    };
    close(&numbers(&sheet.jacobian_rates[0]), &columns);
    close(&numbers(&sheet.jacobian_rates[1]), &A_RATE);
    for (matrix, exact) in sheet.terms.iter().zip(H) {
        close(&numbers(matrix), &exact);
    }
    for equations in sheet.accelerations {
        let found: Vec<f64> = equations.iter().map(|one| values.value(one.right).unwrap()).collect();
        close(&found, &alphas);
    }
    let determinants = sheet.choices.iter().map(|choice| values.value(choice.determinant.unwrap().right).unwrap());
    close(&determinants.collect::<Vec<_>>(), &DETERMINANTS);
}

/// The formulas of the sheet as it prints them.
#[test]
fn formulas_of_the_sheet() {
    let mechanism = linkage_compiler::read(linkage_gallery::source::tokens_of("four_bar")).unwrap().remove(0);
    let lender = Lender::default();
    let sheet = lender.sheet(&linkage_compiler::sheets(&mechanism).unwrap()[0]).unwrap();
    let text = sheet.to_text();
    for line in [
        "J̇[1, 1] = −l₃·θ̇₃·cos(θ₃)",
        "Ȧ[2, 1] = −l₂·θ̇₂·sin(θ₂)",
        "They are the derivatives of J and A themselves",
        "γ_u[1, 1] = −l₃·θ̇₃²·cos(θ₃) − l₄·θ̇₄²·cos(θ₄)",
        "γ_v[2, 1] = −l₂·θ̇₂²·sin(θ₂)",
        "H₁[2, 1] = l₂·θ̈₂·cos(θ₂)",
        "H₂[1, 1] = l₂·θ̇₃·θ̇₂·cos(θ₃)·sin(θ₂ − θ₄)/sin(θ₃ − θ₄) − l₂·θ̇₄·θ̇₂·cos(θ₄)·sin(θ₂ − θ₃)/sin(θ₃ − θ₄)",
        "H₃[1, 1] = −l₂·θ̇₂²·cos(θ₂)",
        "det J_θ₃ = l₂·l₄·sin(θ₂ − θ₄)",
        "Ω_θ₃[1, 2] = −θ̇₃",
        "α_θ₄[2, 1] = θ̈₄",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    assert_eq!(FourBar::DERIVATION.counts().to_string(), "n = 3, p = 2, F = n − p = 1");
}

/// `VG3_B`, `VG4_C` and the accelerations relative to B and C: a point of a link from another one.
#[test]
fn points_of_one_link() {
    let motion = FourBar::default().motion(&solved(), OMEGA2, 0.0).unwrap();
    let (points, rates, bent) = (motion.points, motion.rates, motion.accelerations);
    let coupler = Turning { rate: rates.theta3, acceleration: bent.theta3 };
    let rocker = Turning { rate: rates.theta4, acceleration: bent.theta4 };
    for (link, from, to, velocity, acceleration) in [
        (
            coupler,
            points.b,
            points.g3,
            [434.347_002_293_475_96, -153.377_374_851_118_56],
            [3_294.946_104_695_846, -10_164.413_876_247_678],
        ),
        (
            rocker,
            points.c,
            points.g4,
            [-291.081_939_673_256_04, -240.240_149_694_688],
            [13_192.866_207_801_568, 16_165.486_786_164_536],
        ),
    ] {
        let arm = to.position - from.position;
        let found = [link.relative_velocity(arm), link.relative_acceleration(arm)];
        let matrices = [
            link.rate_matrix() * arm,
            link.rate_matrix() * link.rate_matrix() * arm + link.acceleration_matrix() * arm,
        ];
        for (found, exact) in found.into_iter().chain(matrices).zip([velocity, acceleration].into_iter().cycle()) {
            assert_relative_eq!(found[0], exact[0], max_relative = EXACT);
            assert_relative_eq!(found[1], exact[1], max_relative = EXACT);
        }
        let moved = link.point(&from, arm);
        assert_relative_eq!(moved.velocity, to.velocity, max_relative = EXACT);
        assert_relative_eq!(moved.acceleration, to.acceleration, max_relative = EXACT);
    }
    // Equation 1.3 of the lecture notes: the velocity of G3 as a sum of matrices times rates.
    let q = solved();
    let vectors = [
        PolarVector { value: [20.0, q.theta2], rate: [0.0, rates.theta2] },
        PolarVector { value: [25.0, q.theta3], rate: [0.0, rates.theta3] },
    ];
    let sum = vectors.iter().map(PolarVector::velocity).sum::<linkage::nalgebra::Vector2<f64>>();
    assert_relative_eq!(sum, points.g3.velocity, max_relative = EXACT);
}
