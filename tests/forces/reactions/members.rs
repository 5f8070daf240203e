//! The links of a machine with the forces on them. Three laws hold for each machine: the forces and moments on a link
//! give its acceleration, the forces of a pin on its links add up to the load of the pin, and the forces in joints do no
//! work in a virtual motion that all joints allow.

use linkage::nalgebra::{Point2, Rotation2, Vector2, vector};

/// A link in its motion, by a point of it and its angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub at: Point2<f64>,
    pub angle: f64,
    pub rate: f64,
    pub acceleration: Vector2<f64>,
    /// The angular acceleration.
    pub gain: f64,
    /// The velocity of the point and the angular velocity in a virtual motion.
    pub virtual_motion: (Vector2<f64>, f64),
}

/// The frame of a link in a state (mechanism, pose, rates, accelerations, virtual rates): by a declared point of it, and
/// by its angle unless it only translates.
macro_rules! frame {
    ($state:ident, $point:ident, $angle:ident) => {{
        let (_, pose, rates, accelerations, virtual_rates) = &$state;
        let translating = crate::reactions::members::frame!($state, $point);
        crate::reactions::members::Frame {
            angle: pose.coordinates().$angle,
            rate: rates.$angle,
            gain: accelerations.$angle,
            virtual_motion: (translating.virtual_motion.0, virtual_rates.$angle),
            ..translating
        }
    }};
    ($state:ident, $point:ident) => {{
        let (m, pose, rates, accelerations, virtual_rates) = &$state;
        crate::reactions::members::Frame {
            at: m.points(pose).unwrap().$point,
            angle: 0.0,
            rate: 0.0,
            acceleration: m.point_accelerations(pose, rates, accelerations).unwrap().$point,
            gain: 0.0,
            virtual_motion: (m.point_velocities(pose, virtual_rates).unwrap().$point, 0.0),
        }
    }};
}
pub(super) use frame;

/// The state of a scene without contacts that moves from a position at some rates, with a virtual motion.
macro_rules! state {
    ($scene:ident, $q:expr, $rates:expr, $virtual_rates:expr) => {{
        let m = &$scene.mechanism;
        let pose = m.pose_at(&$q);
        let forces = $scene.forces(0.0, &$q, $rates).unwrap();
        let gains = $scene.mass_matrix(&$q).unwrap().lu().solve(&forces).unwrap();
        let (rates, virtual_rates) = (m.velocity(&pose, $rates).unwrap(), m.velocity(&pose, $virtual_rates).unwrap());
        let accelerations = m.acceleration(&pose, &rates, gains).unwrap();
        (m, pose, rates, accelerations, virtual_rates)
    }};
}
pub(super) use state;

pub(super) fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

impl Frame {
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> Point2<f64> {
        self.at + Rotation2::new(self.angle) * vector![x, y]
    }

    fn acceleration_at(&self, point: Point2<f64>) -> Vector2<f64> {
        let arm = point - self.at;
        self.acceleration + vector![-arm.y, arm.x] * self.gain - arm * self.rate.powi(2)
    }

    /// The power of a force at a point in the virtual motion, and the sum of the magnitudes of its terms.
    fn power(&self, point: Point2<f64>, force: Vector2<f64>) -> [f64; 2] {
        let (velocity, turn) = self.virtual_motion;
        let arm = point - self.at;
        let terms = [force.dot(&velocity), turn * cross(arm, force)];
        [terms[0] + terms[1], force.norm() * (velocity.norm() + (turn * arm.norm()).abs())]
    }
}

/// A link with the forces on it.
#[derive(Debug, Clone)]
pub(super) struct Member {
    pub name: &'static str,
    pub frame: Frame,
    /// The mass and the moment of inertia.
    pub inertia: [f64; 2],
    /// Its centre from the point of the frame, in the axes of the frame.
    pub center: [f64; 2],
    pub joints: Vec<(Point2<f64>, Vector2<f64>)>,
    /// The moment of guides.
    pub joint_moment: f64,
    /// All other forces but gravity, and their moment.
    pub loads: Vec<(Point2<f64>, Vector2<f64>)>,
    pub moment: f64,
}

/// A pin: the forces on its links, its load, its virtual velocity.
pub(super) type Pin = (Vec<Vector2<f64>>, Vector2<f64>, Vector2<f64>);

impl Member {
    /// A link with forces in pins only.
    pub(super) fn new(
        name: &'static str,
        (frame, center): (Frame, [f64; 2]),
        inertia: [f64; 2],
        joints: &[(Point2<f64>, Vector2<f64>)],
    ) -> Self {
        let joints = joints.to_vec();
        Self { name, frame, inertia, center, joints, joint_moment: 0.0, loads: Vec::new(), moment: 0.0 }
    }

    /// Adds a moment of the loads.
    pub(super) fn turned(mut self, moment: f64) -> Self {
        self.moment += moment;
        self
    }

    /// Adds a load.
    pub(super) fn loaded(mut self, at: Point2<f64>, force: Vector2<f64>) -> Self {
        self.loads.push((at, force));
        self
    }

    /// Adds the force and the moment of a guide.
    pub(super) fn guided(mut self, at: Point2<f64>, force: Vector2<f64>, moment: f64) -> Self {
        self.joints.push((at, force));
        self.joint_moment += moment;
        self
    }

    fn obeys(&self, state: &str, gravity: f64, size: f64, length: f64) {
        let (center, [mass, moment]) = (self.frame.place(self.center), self.inertia);
        let forces = self.joints.iter().chain(&self.loads);
        let sum: Vector2<f64> = forces.clone().map(|(_, force)| *force).sum();
        let rest = sum - mass * (self.frame.acceleration_at(center) + vector![0.0, gravity]);
        let moments: f64 = forces.map(|(at, force)| cross(at - center, *force)).sum();
        let turn = moments + self.moment + self.joint_moment - moment * self.frame.gain;
        assert!(rest.norm() < 1e-12 * size, "{state}, {}: {rest} of {size}", self.name);
        assert!(turn.abs() < 1e-12 * size * length, "{state}, {}: {turn} of {size} times {length}", self.name);
    }
}

/// Checks the laws of a machine with a length of it.
pub(super) fn obey(state: &str, (gravity, length): (f64, f64), members: &[Member], pins: &[Pin]) {
    let forces = members.iter().flat_map(|member| member.joints.iter().chain(&member.loads));
    let size = forces.map(|(_, force)| force.norm()).fold(0.0, f64::max);
    members.iter().for_each(|member| member.obeys(state, gravity, size, length));
    for (number, (forces, load, _)) in pins.iter().enumerate() {
        let rest = forces.iter().sum::<Vector2<f64>>() - load;
        assert!(rest.norm() < 1e-12 * size, "{state}, pin {number}: {rest} of {size}");
    }
    // The links give to the joints what the loads of the pins do.
    let on_links = members.iter().flat_map(|member| {
        let turn = member.joint_moment * member.frame.virtual_motion.1;
        let forces = member.joints.iter().map(|&(at, force)| member.frame.power(at, force));
        forces.chain([[turn, turn.abs()]])
    });
    let on_pins = pins.iter().map(|(_, load, velocity)| [-load.dot(velocity), load.norm() * velocity.norm()]);
    let [work, most] = on_links.chain(on_pins).fold([0.0; 2], |[work, most], [more, size]| [work + more, most + size]);
    assert!(most > 0.0 && work.abs() < 1e-12 * most, "{state}: the power {work} of {most}");
}
