//! Random arguments.

use linkage_interpreter::{Data, Design, Mechanism, Record, Shape};

/// Numbers that functions must bear.
const EXTREME: &[f64] = &[0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 1e-300, 1e17];

/// Zeros, and angles near them: many links are nearly in line, so that groups are nearly singular.
const NEAR_ZERO: &[f64] = &[0.0, -0.0, 0.001, -0.002];

/// Random numbers, kept in the order in which they are taken.
pub struct Drawn {
    /// The state of a generator, by Steele, Lea and Flood, SplitMix: the same numbers on every target.
    random: u64,
    /// All numbers that were taken.
    pub all: Vec<f64>,
    /// Special numbers, and their share.
    special: (&'static [f64], f64),
}

impl Drawn {
    /// Numbers of which this share is extreme.
    pub fn new(seed: u64, extreme: f64) -> Self {
        Self { random: linkage_trials::seed(seed), all: Vec::new(), special: (EXTREME, extreme) }
    }

    /// Numbers of which this share is zero or near it.
    pub fn near_zero(seed: u64, share: f64) -> Self {
        Self { special: (NEAR_ZERO, share), ..Self::new(seed, 0.0) }
    }

    /// In [0, 1), evenly.
    fn part(&mut self) -> f64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let bits = (self.random ^ (self.random >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        // 2^-53
        ((bits ^ (bits >> 31)) >> 11) as f64 * (f64::EPSILON / 2.0)
    }

    /// A number of the size of angles and rates, or a special one.
    pub fn number(&mut self) -> f64 {
        let (special, share) = self.special;
        let number = match self.part() < share {
            true => special[(self.part() * special.len() as f64) as usize],
            false => 8.0 * self.part() - 4.0,
        };
        self.all.push(number);
        number
    }

    /// A number near another one; like [`number`](Self::number) if that is none.
    pub fn near(&mut self, value: f64) -> f64 {
        let change = self.number();
        let number = if value.is_finite() { value * (1.0 + 0.05 * change) } else { change };
        *self.all.last_mut().expect("one was drawn") = number;
        number
    }

    /// A number that is not negative, unless it is extreme.
    pub fn size(&mut self) -> f64 {
        let size = self.number().abs();
        *self.all.last_mut().expect("one was drawn") = size;
        size
    }

    pub fn count(&mut self, below: u32) -> u32 {
        let count = (self.part() * f64::from(below)) as u32;
        self.all.push(f64::from(count));
        count
    }

    pub fn list(&mut self, count: usize) -> Data {
        Data::List((0..count).map(|_| Data::Number(self.number())).collect())
    }

    pub fn branch(&mut self, mechanism: &Mechanism) -> Data {
        let [sides, modes, turns] = mechanism.branch_fields();
        let mut fields = Vec::new();
        for (name, solutions) in sides {
            fields.push((name, Data::from(solutions[self.count(2) as usize])));
        }
        for (name, _) in modes {
            let count = self.count(4);
            fields.push((name, if count == 0 { Data::Nothing } else { Data::Count(i64::from(count) - 1) }));
        }
        for (name, _) in turns {
            fields.push((name, Data::Count(self.count(3).into())));
        }
        Data::fields(fields)
    }

    /// An argument of this form.
    pub fn argument(&mut self, mechanism: &Mechanism, design: &Design, shape: &Shape) -> Data {
        let [coordinates, inputs] = mechanism.sizes();
        match shape {
            Shape::Number => Data::Number(self.number()),
            Shape::Record(Record::Inputs) => self.list(inputs),
            Shape::Record(Record::Coordinates | Record::Rates | Record::Accelerations | Record::Jerks) => {
                self.list(coordinates)
            }
            Shape::Record(Record::Pose) => {
                let q = self.list(coordinates);
                design.call("pose_at", &[q]).expect("a pose at any coordinates")
            }
            Shape::Record(Record::Branch) => self.branch(mechanism),
            Shape::List(of, count) => Data::List((0..*count).map(|_| self.argument(mechanism, design, of)).collect()),
            other => panic!("no public function takes {other:?}"),
        }
    }
}
