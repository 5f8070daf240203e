//! Random linkages: joints are placed at random, and the links are as long as their distances.

use std::f64::consts::PI;

use rand::Rng;
use rand::rngs::SmallRng;

use super::linkage::{Coordinate, Form, Linear, Linkage, Output, Row, Sum, Vector, negative, place, vector};

pub const FAMILIES: [&str; 9] = [
    "dyads",
    "geared",
    "geared_group",
    "two_loops",
    "cylinders",
    "two_inputs",
    "ranges",
    "change_points",
    "long_chain",
];

/// A linkage that is being built.
struct Built<'r> {
    random: &'r mut SmallRng,
    unknowns: Vec<(String, bool, f64)>,
    inputs: Vec<(String, bool, f64)>,
    /// Coordinates are numbered as they come: unknowns from 0, inputs from 1000.
    rows: Vec<Row>,
    /// Joints to which more can be attached.
    joints: Vec<Sum>,
}

const INPUTS: usize = 1000;

fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

impl Built<'_> {
    fn number(&mut self, least: f64, most: f64) -> f64 {
        rounded(self.random.random_range(least..most))
    }

    fn input(&mut self, is_angle: bool, value: f64) -> usize {
        let name = if is_angle { "z" } else { "c" };
        self.inputs.push((format!("{name}{}", self.inputs.len()), is_angle, value));
        INPUTS + self.inputs.len() - 1
    }

    fn unknown(&mut self, is_angle: bool, value: f64) -> usize {
        let name = if is_angle { "a" } else { "s" };
        self.unknowns.push((format!("{name}{}", self.unknowns.len()), is_angle, value));
        self.unknowns.len() - 1
    }

    fn value(&self, coordinate: usize) -> f64 {
        if coordinate >= INPUTS { self.inputs[coordinate - INPUTS].2 } else { self.unknowns[coordinate].2 }
    }

    /// A place by the coordinates that are numbered as they come.
    fn place(&self, sum: &Sum) -> [f64; 2] {
        let fixed = |form: &Linear| {
            form.terms.iter().map(|(factor, place)| factor * self.value(*place)).sum::<f64>() + form.constant
        };
        let fixed =
            |of: &Vector| Vector { length: Linear::number(fixed(&of.length)), angle: Linear::number(fixed(&of.angle)) };
        place(&sum.iter().map(fixed).collect(), &[])
    }

    fn ground(&mut self) -> Sum {
        let (length, angle) = (self.number(1.0, 4.0), self.number(-0.5, 0.5));
        let angle = if self.random.random_bool(0.5) { 0.0 } else { angle };
        vec![vector(length, Linear::number(angle))]
    }

    fn joint(&mut self) -> Sum {
        let place = self.random.random_range(0..self.joints.len());
        self.joints[place].clone()
    }

    /// A link from a joint to a place: its length, and its angle as an unknown.
    fn link(&mut self, from: &Sum, to: [f64; 2]) -> Vector {
        let [x, y] = self.place(from);
        let length = rounded((to[0] - x).hypot(to[1] - y)).max(0.2);
        let angle = self.unknown(true, (to[1] - y).atan2(to[0] - x));
        vector(length, Linear::of(angle))
    }

    /// A place near two joints.
    fn near(&mut self, one: &Sum, other: &Sum) -> [f64; 2] {
        let [one, other] = [one, other].map(|sum| self.place(sum));
        [0, 1].map(|axis| 0.5 * (one[axis] + other[axis]) + self.number(-2.5, 2.5))
    }

    fn add_loop(&mut self, one: &Sum, other: &Sum) {
        self.rows.push(Row::Loop(one.iter().cloned().chain(negative(other)).collect()));
    }

    /// A joint of the link at an angle, off its axis.
    fn off(&mut self, from: &Sum, along: &Vector) -> Sum {
        let (length, angle) = (self.number(0.5, 2.5), self.number(-1.5, 1.5));
        let mut sum = from.clone();
        sum.push(vector(length, along.angle.clone().plus(angle)));
        sum
    }

    /// A dyad of one of the kinds between two joints.
    fn dyad(&mut self, one: &Sum, other: &Sum) {
        let to = self.near(one, other);
        let first = self.link(one, to);
        let mut end = one.clone();
        end.push(first.clone());
        match self.random.random_range(0..4) {
            // A slider on a straight line.
            0 => {
                let angle = self.number(-1.5, 1.5);
                let ([x, y], [x0, y0]) = (to, self.place(other));
                let along = (x - x0) * angle.cos() + (y - y0) * angle.sin();
                let off = rounded(-(x - x0) * angle.sin() + (y - y0) * angle.cos());
                let slider = self.unknown(false, along);
                let mut line = other.clone();
                line.push(Vector { length: Linear::of(slider), angle: Linear::number(angle) });
                line.push(vector(off, Linear::number(angle + PI / 2.0)));
                self.add_loop(&end, &line);
            }
            _ => {
                let second = self.link(other, to);
                let mut there = other.clone();
                there.push(second);
                self.add_loop(&end, &there);
            }
        }
        let off = self.off(one, &first);
        self.joints.push(off);
        self.joints.push(end);
    }

    /// A link with three joints on three links: a group of four unknowns.
    fn triad(&mut self, legs: [Sum; 3]) {
        let to = self.near(&legs[0], &legs[1]);
        let body = self.number(-3.0, 3.0);
        let corners: [(f64, f64); 2] =
            [(self.number(0.5, 2.0), self.number(-1.0, 1.0)), (self.number(0.5, 2.0), self.number(1.0, 2.5))];
        let first = self.link(&legs[0], to);
        let angle = self.unknown(true, body);
        let mut from = legs[0].clone();
        from.push(first);
        for ((length, off), leg) in corners.into_iter().zip(&legs[1..]) {
            let mut corner = from.clone();
            corner.push(vector(length, Linear::of(angle).plus(off)));
            let there = self.place(&corner);
            let link = self.link(leg, there);
            let mut end = leg.clone();
            end.push(link);
            self.add_loop(&corner, &end);
            self.joints.push(corner);
        }
    }

    /// A wheel: an angle by an equation.
    fn wheel(&mut self, by: usize) -> usize {
        let factor = [2.0, 3.0, -1.0, -2.0, 4.0][self.random.random_range(0..5)];
        let constant = self.number(-1.0, 1.0);
        let (value, driven) = (self.value(by), self.unknowns.len());
        let other = if self.random.random_bool(0.3) { (0..driven).rfind(|of| self.unknowns[*of].1) } else { None };
        let mut form = Linear { terms: vec![(factor, by)], constant };
        let mut sum = factor * value + constant;
        if let Some(other) = other {
            form.terms.push((2.0, other));
            sum += 2.0 * self.value(other);
        }
        let wheel = self.unknown(true, sum);
        form.terms.push((-1.0, wheel));
        self.rows.push(Row::Equation(form));
        wheel
    }

    fn crank(&mut self, angle: usize) -> Sum {
        let length = self.number(0.5, 2.0);
        let mut crank = if self.random.random_bool(0.5) { Vec::new() } else { self.ground() };
        crank.push(vector(length, Linear::of(angle)));
        crank
    }

    fn finished(mut self, family: &'static str, has_ranges: bool) -> Linkage {
        let n = self.unknowns.len();
        let moved = |form: &mut Linear| {
            form.terms
                .iter_mut()
                .filter(|(_, place)| *place >= INPUTS)
                .for_each(|(_, place)| *place = *place - INPUTS + n);
        };
        let moved_sum =
            |sum: &mut Sum| sum.iter_mut().for_each(|of| [&mut of.length, &mut of.angle].into_iter().for_each(moved));
        for row in &mut self.rows {
            match row {
                Row::Loop(sum) => moved_sum(sum),
                Row::Equation(form) => moved(form),
            }
        }
        // The direction of a wheel, by which an input is an angle.
        let mark = (family == "geared_group" && self.random.random_bool(0.8))
            .then(|| ("Z".to_owned(), vec![vector(1.0, Linear::of(n))]));
        let mut point = self.joints.last().cloned().unwrap_or_default();
        moved_sum(&mut point);
        let all = self.unknowns.iter().chain(&self.inputs);
        let start: Vec<f64> = all.clone().map(|(.., value)| *value).collect();
        let mut coordinates: Vec<Coordinate> = all
            .map(|(name, is_angle, _)| Coordinate { name: name.clone(), is_angle: *is_angle, range: None })
            .collect();
        let last = n - 1;
        let mut outputs = vec![
            Output { name: "o".to_owned(), form: Form::Linear(Linear::of(last)), range: None },
            Output { name: "d".to_owned(), form: Form::Angle(point.clone()), range: None },
        ];
        if has_ranges {
            let mut range = |value: f64| {
                Some([
                    rounded(value - self.random.random_range(0.05..1.5)),
                    rounded(value + self.random.random_range(0.05..1.5)),
                ])
            };
            let input = range(start[n]);
            let unknown = range(start[last]);
            let output = range(start[0]);
            outputs.push(Output { name: "w".to_owned(), form: Form::Linear(Linear::of(0)), range: None });
            match self.random.random_range(0..5) {
                0 => coordinates[n].range = input,
                // More than a turn.
                4 => coordinates[n].range = Some([rounded(start[n] - 5.0), rounded(start[n] + 7.0)]),
                1 => coordinates[last].range = unknown,
                2 => outputs[2].range = output,
                _ => {
                    coordinates[n].range = input;
                    outputs[2].range = output;
                }
            }
        }
        Linkage {
            family,
            unknowns: n,
            coordinates,
            rows: self.rows,
            points: [("P".to_owned(), point)].into_iter().chain(mark).collect(),
            outputs,
            start,
        }
    }
}

/// A random linkage of a family.
pub fn linkage(family: &'static str, random: &mut SmallRng) -> Linkage {
    let mut built = Built { random, unknowns: Vec::new(), inputs: Vec::new(), rows: Vec::new(), joints: Vec::new() };
    let start = built.number(-3.0, 3.0);
    if family == "cylinders" {
        let length = built.number(1.0, 3.0);
        let input = built.input(false, length);
        let (ground, to) = (built.ground(), built.number(-3.0, 3.0));
        // A rocker on a cylinder: its foot, the piston, the pin.
        let cylinder = built.unknown(true, to);
        let mut piston = ground;
        piston.push(Vector { length: Linear::of(input), angle: Linear::of(cylinder) });
        let pin = built.place(&piston);
        let rocker = built.link(&Vec::new(), pin);
        let end = vec![rocker.clone()];
        built.add_loop(&end, &piston);
        let off = built.off(&Vec::new(), &rocker);
        built.joints.extend([end, off]);
        if built.random.random_bool(0.6) {
            let (one, other) = (built.joint(), built.ground());
            built.dyad(&one, &other);
        }
        return built.finished(family, false);
    }
    let input = built.input(true, start);
    let crank = built.crank(input);
    built.joints.push(crank.clone());
    match family {
        "geared" | "geared_group" => {
            if built.random.random_bool(0.5) {
                let ground = built.ground();
                built.dyad(&crank, &ground);
            }
            let wheel = built.wheel(input);
            let driven = built.crank(wheel);
            if family == "geared" {
                let joint = built.joint();
                built.dyad(&driven, &joint);
            } else {
                let legs = [built.ground(), built.ground(), driven];
                built.triad(legs);
            }
        }
        "two_loops" => {
            let legs = [crank, built.ground(), built.ground()];
            built.triad(legs);
        }
        "two_inputs" => {
            let other = if built.random.random_bool(0.5) {
                let value = built.number(-3.0, 3.0);
                let other = built.input(true, value);
                built.crank(other)
            } else {
                let length = built.number(0.5, 2.0);
                let other = built.input(false, length);
                vec![Vector { length: Linear { terms: vec![(1.0, other)], constant: 1.0 }, angle: Linear::number(0.0) }]
            };
            built.dyad(&crank, &other);
        }
        "change_points" => {
            let [a, b] = [built.number(0.5, 2.0), built.number(2.1, 4.0)];
            // Parallelograms, antiparallelograms and kites.
            let [crank, coupler, rocker, frame] =
                if built.random.random_bool(0.6) { [a, b, a, b] } else { [a, b, b, a] };
            let [frame, crank] = [vec![vector(frame, Linear::number(0.0))], vec![vector(crank, Linear::of(input))]];
            let [p, r] = [coupler, rocker].map(|_| built.unknown(true, 0.0));
            let (f, c) = (built.place(&frame), built.place(&crank));
            let (x, y) = (f[0] - c[0], f[1] - c[1]);
            let distance = x.hypot(y);
            let cos = (distance * distance + coupler * coupler - rocker * rocker) / (2.0 * distance * coupler);
            let angle = y.atan2(x) + cos.clamp(-1.0, 1.0).acos();
            built.unknowns[p].2 = angle;
            let pin = [c[0] + coupler * angle.cos(), c[1] + coupler * angle.sin()];
            built.unknowns[r].2 = (pin[1] - f[1]).atan2(pin[0] - f[0]);
            let mut end = crank.clone();
            end.push(vector(coupler, Linear::of(p)));
            let mut there = frame;
            there.push(vector(rocker, Linear::of(r)));
            built.add_loop(&end, &there);
            built.joints.push(end);
            if built.random.random_bool(0.4) {
                let (one, other) = (built.joint(), built.ground());
                built.dyad(&one, &other);
            }
        }
        _ => {
            let dyads = if family == "long_chain" { 5 } else { built.random.random_range(1..4) };
            for _ in 0..dyads {
                let one = built.joint();
                let other = if built.joints.len() > 2 && built.random.random_bool(0.3) {
                    built.joint()
                } else {
                    built.ground()
                };
                let other = if built.place(&one) == built.place(&other) { built.ground() } else { other };
                built.dyad(&one, &other);
            }
        }
    }
    built.finished(family, family == "ranges")
}
