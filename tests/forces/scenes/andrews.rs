//! Andrews' squeezing mechanism as it is published.

use super::virtual_work::agrees;

use linkage_gallery::andrews_scene::*;

/// Andrews' mechanism: at the start as the Test Set for IVP Solvers (F. Mazzia, C. Magherini) gives it, in motion
/// W' M W with the mass matrix of the seven coordinates that the Test Set prints.
#[test]
fn andrews_as_published() {
    let scene = Squeezing::default();
    let start = SqueezerCoordinates {
        beta: -0.061_713_890_014_276_5,
        theta: 0.0,
        gamma: 0.455_279_819_163_070_4,
        phi: 0.222_668_390_165_885_88,
        delta: 0.487_364_979_543_842_54,
        omega: -0.222_668_390_165_885_88,
        epsilon: 1.230_547_444_549_821_3,
    };
    let derivative = scene.rates(0.0, &start, 0.0).unwrap();
    agrees("beta''", derivative.input_accelerations.beta, 14_222.443_919_954_114, 0.0);
    let published = [98.566_870_396_241_09, -6.122_688_344_255_663, 0.0, 0.0, 0.0, 0.0];
    for (found, expected) in scene.reactions(0.0, &start, 0.0).unwrap().multipliers.iter().zip(published) {
        agrees("lambda", *found, expected, 1e2);
    }

    let squeezer = &scene.mechanism;
    let SqueezerCoordinates { theta, phi, omega, .. } = start;
    let Squeezer { rr, e, zt, zf, u, .. } = *squeezer;
    let Squeezing { ra, da, ea, sa, sb, ta, tb, ua, ub, fa, .. } = scene;
    let Squeezing { m1, m2, m3, m4, m5, m6, m7, i1, i2, i3, i4, i5, i6, i7, .. } = scene;
    let mut m = linkage::nalgebra::SMatrix::<f64, 7, 7>::zeros();
    m[(0, 0)] = m1 * ra * ra + m2 * (rr * rr - 2.0 * da * rr * theta.cos() + da * da) + i1 + i2;
    m[(1, 0)] = m2 * (da * da - da * rr * theta.cos()) + i2;
    m[(1, 1)] = m2 * da * da + i2;
    m[(2, 2)] = m3 * (sa * sa + sb * sb) + i3;
    m[(3, 3)] = m4 * (e - ea) * (e - ea) + i4;
    m[(4, 3)] = m4 * ((e - ea) * (e - ea) + zt * (e - ea) * phi.sin()) + i4;
    m[(4, 4)] =
        m4 * (zt * zt + 2.0 * zt * (e - ea) * phi.sin() + (e - ea) * (e - ea)) + m5 * (ta * ta + tb * tb) + i4 + i5;
    m[(5, 5)] = m6 * (zf - fa) * (zf - fa) + i6;
    m[(6, 5)] = m6 * ((zf - fa) * (zf - fa) - u * (zf - fa) * omega.sin()) + i6;
    m[(6, 6)] =
        m6 * ((zf - fa) * (zf - fa) - 2.0 * u * (zf - fa) * omega.sin() + u * u) + m7 * (ua * ua + ub * ub) + i6 + i7;
    m.fill_upper_triangle_with_lower_triangle();
    let ratios = squeezer.velocity_ratios(&squeezer.pose_at(&start)).unwrap();
    let all = linkage::nalgebra::SVector::<f64, 7>::from_fn(|row, _| if row == 0 { 1.0 } else { ratios[row - 1] });
    agrees("W' M W", scene.mass_matrix(&start).unwrap()[0], (all.transpose() * m * all)[0], 0.0);
    agrees("spring", scene.energy(&start, 0.0).unwrap().potential, 1.435_796_399_161_670_2, 0.0);

    // After 0.03 s, integrated with 42 digits and given to 20: PSIDE's published values agree to 6.
    let later = SqueezerCoordinates {
        beta: 15.810_771_195_153_707,
        theta: -15.756_371_058_411_84,
        gamma: 0.040_822_240_119_645_8,
        phi: -0.534_730_116_342_079_6,
        delta: 0.524_409_965_879_954_1,
        omega: 0.534_730_116_342_079_6,
        epsilon: 1.048_080_741_041_938,
    };
    let derivative = scene.rates(0.03, &later, 1_139.920_302_259_106).unwrap();
    agrees("theta'", derivative.rates.theta, -1_424.379_295_177_540_1, 0.0);
    agrees("epsilon'", derivative.rates.epsilon, 0.323_179_149_249_130_9, 0.0);
    agrees("beta''", derivative.input_accelerations.beta, -24_631.763_122_874_634, 0.0);
    let reactions = scene.reactions(0.03, &later, 1_139.920_302_259_106).unwrap().multipliers;
    let integrated = [
        199.175_348_104_538_63,
        -29.755_309_974_971_763,
        23.066_543_611_622_15,
        31.452_725_275_771_137,
        22.642_494_786_394_38,
        11.617_392_352_611_256,
    ];
    for (found, expected) in reactions.iter().zip(integrated) {
        agrees("lambda", *found, expected, 0.0);
    }
    let energy = scene.energy(&later, 1_139.920_302_259_106).unwrap();
    let work = scene.mom * (later.beta - start.beta);
    agrees("energy", energy.kinetic + energy.potential, 1.435_796_399_161_670_2 + work, 0.0);
}
