//! The best fit of a path to a given curve.

use linkage::nalgebra::Complex;

/// A motion with a scale, z -> `turn` z + `shift` in complex numbers, that brings a closed path as close as possible to a
/// closed curve, of all starts on the path and both senses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The root mean square of the distances between points of the curve and those of the moved path.
    pub distance: f64,
    /// The scale and the rotation, as absolute value and argument.
    pub turn: Complex<f64>,
    /// The translation.
    pub shift: Complex<f64>,
    /// The position of the path at the first point of the curve.
    pub start: usize,
    /// True if the path is followed in its order, false if against it.
    pub is_forward: bool,
}

impl Fit {
    /// The best fit of a path to a curve with as many points; none if the path has no extent.
    ///
    /// Both paths are moved so that their centroids are 0. With c = sum conj(z) w, the sum of |w - turn z|^2 is least for
    /// turn = c / sum |z|^2, and this least value is sum |w|^2 - |c|^2 / sum |z|^2. Source: S. Umeyama, "Least-squares
    /// estimation of transformation parameters between two point patterns", IEEE Transactions on Pattern Analysis and
    /// Machine Intelligence 13 (1991), without reflections.
    #[must_use]
    pub fn new(path: &[Complex<f64>], curve: &[Complex<f64>]) -> Option<Self> {
        let count = path.len();
        if count != curve.len() {
            return None;
        }
        let [centre, middle] = [path, curve].map(mean);
        // Twice, so that the path from each start on is a slice.
        let centred: Vec<_> = path.iter().chain(path).map(|z| z - centre).collect();
        // Against its order the path fits the curve as in its order the curve against its order.
        let mut backward = curve.to_vec();
        backward.get_mut(1..)?.reverse();
        let fits = [(true, curve), (false, &backward)].into_iter().flat_map(|(is_forward, curve)| {
            products(&centred, curve).into_iter().enumerate().map(move |(start, c)| (c, start, is_forward))
        });
        // The first one of equal fits.
        let best = fits.reduce(|best, fit| if fit.0.norm_sqr() > best.0.norm_sqr() { fit } else { best });
        let (c, start, is_forward) = best?;
        let squares: f64 = centred.iter().take(count).map(Complex::norm_sqr).sum();
        if squares == 0.0 {
            return None;
        }
        let turn = c / squares;
        let fit = Self { distance: 0.0, turn, shift: middle - turn * centre, start, is_forward };
        // From the points, as the difference of the formula cancels.
        let gaps =
            (0..).zip(curve).filter_map(|(k, w)| Some((fit.place(*path.get(fit.position(k, count))?) - w).norm_sqr()));
        Some(Self { distance: (gaps.sum::<f64>() / count as f64).sqrt(), ..fit })
    }

    /// The moved place of a point.
    #[must_use]
    pub fn place(&self, point: Complex<f64>) -> Complex<f64> {
        self.turn * point + self.shift
    }

    /// The position of a path of this many points that belongs to a point of the curve.
    #[must_use]
    pub fn position(&self, point: usize, count: usize) -> usize {
        let steps = if self.is_forward { point } else { count - point };
        (self.start + steps) % count
    }
}

fn mean(points: &[Complex<f64>]) -> Complex<f64> {
    points.iter().sum::<Complex<f64>>() / points.len() as f64
}

/// The sum of conj(z) w for each start on a path, which is given twice.
fn products(path: &[Complex<f64>], curve: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let mut sums = vec![Complex::ZERO; curve.len()];
    // All sums at a time, so that none waits for the addition before.
    for (path, w) in path.windows(curve.len()).zip(curve) {
        for (sum, z) in sums.iter_mut().zip(path) {
            *sum += z.conj() * w;
        }
    }
    sums
}
