//! Kinematics by dual numbers: Newton's method from a guess, velocity and acceleration from the constraints alone, with
//! num-dual's Jacobian and nalgebra's LU.

use linkage::nalgebra::SVector;
use num_dual::{Dual2_64, Dual64, DualNum, DualSVec64};

use crate::mechanisms::{FourBar, Jansen, SliderCrank, StephensonIII};

/// A dual number of any kind.
pub trait Number: DualNum<Primitive = f64> + Copy {}

impl<D: DualNum<Primitive = f64> + Copy> Number for D {}

/// The constraints of a mechanism with one input and N unknowns.
pub trait Constraints<const N: usize> {
    fn residual<D: Number>(&self, input: D, unknowns: [D; N]) -> [D; N];
}

/// The unknowns with their rates and accelerations.
pub type State<const N: usize> = [SVector<f64, N>; 3];

// The bounds of nalgebra's LU are not implied by those of its vectors: one function for each number of unknowns.
macro_rules! states {
    ($($name:ident $N:literal,)*) => {$(
        /// The state near a guess of the unknowns; `None` without convergence, or if J is singular.
        #[inline(never)]
        pub fn $name(
            m: &impl Constraints<$N>,
            theta: f64,
            rate: f64,
            acceleration: f64,
            guess: SVector<f64, $N>,
        ) -> Option<State<$N>> {
            let residual = |unknowns: SVector<DualSVec64<$N>, $N>| {
                SVector::from(m.residual(DualSVec64::from_re(theta), unknowns.into()))
            };
            let mut unknowns = guess;
            for _ in 0..20 {
                let (values, jacobian) = num_dual::jacobian(residual, &unknowns);
                let lu = jacobian.lu();
                let step = lu.solve(&values)?;
                unknowns -= step;
                if step.amax() < 1e-12 * unknowns.amax() {
                    let by_input = m.residual(Dual64::new(theta, 1.0), unknowns.map(Dual64::from_re).into());
                    let by_input = SVector::from(by_input.map(|row| row.eps));
                    let rates = lu.solve(&(by_input * -rate))?;
                    let moving = std::array::from_fn(|index| Dual2_64::new(unknowns[index], rates[index], 0.0));
                    let gamma = m.residual(Dual2_64::new(theta, rate, 0.0), moving).map(|row| row.v2);
                    let right = -(SVector::from(gamma) + by_input * acceleration);
                    return Some([unknowns, rates, lu.solve(&right)?]);
                }
            }
            None
        }
    )*};
}

states! { two 2, four 4, eight 8, ten 10, thirty_two 32, }

/// The components of a vector of this length at an angle.
fn at<D: Number>(length: f64, angle: D) -> [D; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * length, sine * length]
}

fn sum<D: Number>(vectors: &[[D; 2]], [x, y]: [f64; 2]) -> [D; 2] {
    vectors.iter().fold([D::from(x), D::from(y)], |[a, b], [c, d]| [a + *c, b + *d])
}

fn back<D: Number>([x, y]: [D; 2]) -> [D; 2] {
    [-x, -y]
}

impl Constraints<2> for FourBar {
    fn residual<D: Number>(&self, theta: D, [theta3, theta4]: [D; 2]) -> [D; 2] {
        sum(&[at(self.l2, theta), at(self.l3, theta3), at(self.l4, theta4)], [-self.l1, 0.0])
    }
}

impl Constraints<2> for SliderCrank {
    fn residual<D: Number>(&self, theta: D, [phi, s]: [D; 2]) -> [D; 2] {
        sum(&[at(self.crank, theta), at(self.rod, phi), [-s, D::from(0.0)]], [0.0, -self.offset])
    }
}

impl Constraints<4> for StephensonIII {
    fn residual<D: Number>(&self, theta: D, [theta3, theta4, theta5, theta6]: [D; 4]) -> [D; 4] {
        let (crank, [x, y]) = (at(self.a, theta), at(1.0, theta3));
        let arm = [x * self.px - y * self.py, x * self.py + y * self.px];
        let [a, b] = sum(&[crank, at(self.b, theta3), back(at(self.c, theta4))], [-self.d, 0.0]);
        let [c, d] = sum(&[crank, arm, at(self.e, theta5), back(at(self.f, theta6))], [-self.fx, -self.fy]);
        [a, b, c, d]
    }
}

impl Constraints<10> for Jansen {
    fn residual<D: Number>(&self, theta: D, unknowns: [D; 10]) -> [D; 10] {
        let [b, j, d, e, c, k, f, g, h, i] = unknowns;
        let (crank, pivot) = (at(self.m, theta), [self.a, self.l]);
        let (b, c, d, g) = (at(self.b, b), at(self.c, c), at(self.d, d), at(self.g, g));
        let [r0, r1] = sum(&[crank, at(self.j, j), back(b)], pivot);
        let [r2, r3] = sum(&[b, at(self.e, e), back(d)], [0.0; 2]);
        let [r4, r5] = sum(&[crank, at(self.k, k), back(c)], pivot);
        let [r6, r7] = sum(&[d, at(self.f, f), back(c), back(g)], [0.0; 2]);
        let [r8, r9] = sum(&[g, at(self.h, h), back(at(self.i, i))], [0.0; 2]);
        [r0, r1, r2, r3, r4, r5, r6, r7, r8, r9]
    }
}

/// Four-bars in a row.
impl<const N: usize, const LOOPS: usize> Constraints<N> for [[f64; 4]; LOOPS] {
    fn residual<D: Number>(&self, theta: D, unknowns: [D; N]) -> [D; N] {
        let mut residual = unknowns;
        let mut input = theta;
        let rows = residual.as_chunks_mut::<2>().0.iter_mut();
        for ((&[a, b, c, d], row), &[coupler, rocker]) in self.iter().zip(rows).zip(unknowns.as_chunks().0) {
            *row = sum(&[at(a, input), at(b, coupler), back(at(c, rocker))], [-d, 0.0]);
            input = rocker;
        }
        residual
    }
}
