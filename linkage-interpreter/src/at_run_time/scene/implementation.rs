//! The trait of scenes.

use linkage_dynamics::{
    Bearing, Contact, Energy, Equations, Kink, MotionError, Power, Prescribed, Scene, StateParts, Unreduced,
};
use linkage_runtime::jacobian::Vector;
use linkage_runtime::{Build as _, Column, Dim, Joint};
use smallvec::SmallVec;

use super::forces::JointForcesAtRunTime;
use super::read::prescribed;
use super::{ContactCount, SceneAtRunTime, StateCount};
use crate::at_run_time::coordinates::column;
use crate::at_run_time::read::{field, matrix, number, numbers};
use crate::at_run_time::{AtRunTime, CoordinatesAtRunTime, Count, MOST, OfTheRuntime};
use crate::machine::Value;

/// The result of a call, or the error of the scene.
type Found<'p, X> = Result<X, MotionError<&'p str>>;

/// Does not compile where an algorithm asks a type for the order of its coordinates.
fn of_the_value<V: Dim, X>() -> X {
    const { assert!(V::CAPACITY == usize::MAX, "the order of the coordinates is that of the value") };
    unreachable!("no number of inputs is as large")
}

fn list(numbers: &[f64]) -> Value {
    Value::list(numbers.iter().copied().map(Value::Number))
}

impl<V: Dim> SceneAtRunTime<'_, V> {
    /// t, q and q' as arguments.
    fn moving(&self, t: f64, q: &CoordinatesAtRunTime<V>, rates: &CoordinatesAtRunTime<V>) -> [Value; 3] {
        [Value::Number(t), self.mechanism.coordinates_value(q), self.mechanism.coordinates_value(rates)]
    }

    /// For each coordinate in the order of the fields, its place among unknowns and inputs.
    fn places(&self) -> impl Iterator<Item = Result<usize, usize>> {
        let driver = self.prepared.mechanism.driver;
        driver.coordinates.iter().filter_map(|name| {
            let of = |names: &[_]| names.iter().position(|other| other == name);
            of(&driver.unknowns).map(Ok).or_else(|| of(&driver.inputs).map(Err))
        })
    }
}

impl<'p, V: Dim> Scene for SceneAtRunTime<'p, V> {
    type Scalar = f64;
    type U = Count;
    type V = V;
    type State = StateCount;
    type Contacts = ContactCount;
    type Mechanism = AtRunTime<'p, V>;
    type Reactions = JointForcesAtRunTime<'p, V>;

    const NAME: &'static str = panic!("the name is one of the value");
    const BEARINGS: bool = panic!("bearings are those of the value");
    const KINKS: &'static [Kink] = panic!("the kinks are those of the value");

    fn name(&self) -> &'p str {
        &self.prepared.scene.name
    }
    fn has_bearings(&self) -> bool {
        self.prepared.scene.has_bearings
    }
    fn kinks(&self) -> impl Iterator<Item = Kink<&'p str>> {
        self.prepared.scene.kinks.iter().map(|kink| Kink { effect: kink.effect.as_str(), is_timed: kink.is_timed })
    }
    fn joints(&self) -> impl Iterator<Item = Joint<&'p str>> {
        self.prepared.joints.iter().copied()
    }
    fn mechanism(&self) -> &AtRunTime<'p, V> {
        &self.mechanism
    }
    fn contact_count(&self) -> ContactCount {
        self.counts().2
    }

    fn state(_: &CoordinatesAtRunTime<V>, _: &Column<f64, V>) -> Column<f64, StateCount> {
        of_the_value::<V, _>()
    }
    fn parts(_: &Column<f64, StateCount>) -> StateParts<CoordinatesAtRunTime<V>, Column<f64, V>> {
        of_the_value::<V, _>()
    }
    fn state_of(&self, q: &CoordinatesAtRunTime<V>, input_rates: &Column<f64, V>) -> Column<f64, StateCount> {
        let number = |place| match place {
            Ok(unknown) => q.unknowns.as_slice().get(unknown),
            Err(input) => q.inputs.as_slice().get(input),
        };
        let coordinates = self.places().map(|place| number(place).copied().unwrap_or(f64::NAN));
        let all: SmallVec<[f64; MOST]> = coordinates.chain(input_rates.iter().copied()).collect();
        column(&all)
    }
    fn parts_of(&self, state: &Column<f64, StateCount>) -> StateParts<CoordinatesAtRunTime<V>, Column<f64, V>> {
        let (u, v, _) = self.counts();
        let (mut q, mut input_rates) = (CoordinatesAtRunTime { unknowns: u.zeros(), inputs: v.zeros() }, v.zeros());
        let mut numbers = state.iter();
        for (place, number) in self.places().zip(&mut numbers) {
            match place {
                Ok(unknown) => q.unknowns[unknown] = *number,
                Err(input) => q.inputs[input] = *number,
            }
        }
        input_rates.iter_mut().zip(numbers).for_each(|(rate, number)| *rate = *number);
        StateParts { q, input_rates }
    }

    fn check(&self) -> Found<'p, ()> {
        self.prepared.result("check", []).map(|_| ())
    }
    fn derivative(&self, t: f64, state: &Column<f64, StateCount>) -> Found<'p, Column<f64, StateCount>> {
        let found = self.prepared.result("derivative", [Value::Number(t), list(state.as_slice())])?;
        Ok(column(&numbers(&found)))
    }
    fn equations(&self, t: f64, state: &Column<f64, StateCount>) -> Found<'p, Equations<f64, Count, V>> {
        let (_, v, contacts) = self.counts();
        if contacts.count() > 0 {
            let found = self.prepared.result("equations", [Value::Number(t), list(state.as_slice())])?;
            return Ok(self.read_equations(&found));
        }
        // The function of a scene without contacts calls `Equations::at` on the mechanism.
        let StateParts { q, input_rates } = self.parts_of(state);
        let at = || self.mechanism.coordinates_value(&q);
        let mass = matrix(&self.prepared.result("mass_matrix", [at()])?, v, v);
        let moving = [Value::Number(t), at(), self.mechanism.inputs_value(&input_rates)];
        let forces: Column<f64, V> = column(&numbers(&self.prepared.result("forces", moving)?));
        Equations::at(&self.mechanism, &q, input_rates, mass, forces)
    }
    fn contacts(
        &self,
        t: f64,
        q: &CoordinatesAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, Column<Contact<f64, Count, V, &'p str>, ContactCount>> {
        let found = self.prepared.result("contacts", self.moving(t, q, rates))?;
        let all = found.as_list().unwrap_or_default();
        Ok(self.contact_count().column(|place| self.read_contact(all.get(place).unwrap_or(&Value::Absent))))
    }
    fn bearings(
        &self,
        t: f64,
        q: &CoordinatesAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, Column<Option<Bearing<f64, Count, V, ContactCount>>, ContactCount>> {
        if !self.has_bearings() {
            return Ok(self.contact_count().repeat(None));
        }
        let found = self.prepared.result("bearings", self.moving(t, q, rates))?;
        let all = found.as_list().unwrap_or_default();
        Ok(self.contact_count().column(|place| self.read_bearing(all.get(place)?)))
    }
    fn unreduced(
        &self,
        t: f64,
        q: &CoordinatesAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, Unreduced<f64, Count, V>> {
        Ok(self.read_unreduced(&self.prepared.result("unreduced", self.moving(t, q, rates))?))
    }
    fn reactions(
        &self,
        t: f64,
        q: &CoordinatesAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
        accelerations: &Vector<f64, Count, V>,
        contact_forces: &Column<f64, ContactCount>,
    ) -> Found<'p, JointForcesAtRunTime<'p, V>> {
        let of = self.prepared.fields;
        let fields = [
            (of.unknowns, list(accelerations.unknowns.as_slice())),
            (of.inputs, list(accelerations.inputs.as_slice())),
        ];
        let [t, q, rates] = self.moving(t, q, rates);
        let accelerations = Value::record(fields);
        let given = [t, q, rates, accelerations, list(contact_forces.as_slice())];
        let found = self.prepared.result("reactions", given)?;
        Ok(JointForcesAtRunTime::read(&self.prepared.joints, &found))
    }
    fn kink(&self, place: usize, t: f64, q: &CoordinatesAtRunTime<V>, rates: &CoordinatesAtRunTime<V>) -> f64 {
        if place >= self.prepared.scene.kinks.len() {
            return 1.0;
        }
        let [t, q, rates] = self.moving(t, q, rates);
        number(&self.prepared.value("kink", [Value::Count(place as i64), t, q, rates]))
    }
    fn gap_changes(
        &self,
        q: &CoordinatesAtRunTime<V>,
        moves: &CoordinatesAtRunTime<V>,
    ) -> Column<Option<f64>, ContactCount> {
        if !self.prepared.has("gap_changes") {
            return self.contact_count().repeat(None);
        }
        let given = [q, moves].map(|of| self.mechanism.coordinates_value(of));
        let found = self.prepared.value("gap_changes", given);
        let all = found.as_list().unwrap_or_default();
        self.contact_count().column(|place| all.get(place).filter(|of| !matches!(of, Value::Absent)).map(number))
    }
    fn kinetic_and_potential(
        &self,
        q: &CoordinatesAtRunTime<V>,
        input_rates: &Column<f64, V>,
    ) -> Found<'p, Option<Energy<f64>>> {
        if !self.prepared.has("kinetic_and_potential") {
            return Ok(None);
        }
        let given = [self.mechanism.coordinates_value(q), self.mechanism.inputs_value(input_rates)];
        let (found, of) = (self.prepared.result("kinetic_and_potential", given)?, self.prepared.fields);
        let number = |name| number(field(&found, name));
        Ok(Some(Energy { kinetic: number(of.kinetic), potential: number(of.potential) }))
    }
    fn applied_and_dissipated(
        &self,
        t: f64,
        q: &CoordinatesAtRunTime<V>,
        input_rates: &Column<f64, V>,
    ) -> Found<'p, Option<Power<f64>>> {
        if !self.prepared.has("applied_and_dissipated") {
            return Ok(None);
        }
        let given = [Value::Number(t), self.mechanism.coordinates_value(q), self.mechanism.inputs_value(input_rates)];
        // Frictions by reaction dissipate by the loads of the motion.
        let found = self.prepared.result_by("applied_and_dissipated", given, Some(&OfTheRuntime))?;
        let of = self.prepared.fields;
        let number = |name| number(field(&found, name));
        Ok(Some(Power { applied: number(of.applied), dissipated: number(of.dissipated) }))
    }
    fn prescribed(&self, t: f64) -> Column<Option<Prescribed<f64>>, V> {
        let found = self.prepared.value("prescribed", [Value::Number(t)]);
        let all = found.as_list().unwrap_or_default();
        self.mechanism.inputs.column(|input| prescribed(all.get(input)?))
    }
}
