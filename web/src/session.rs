//! The compiled text, and the motion that was followed last.

use serde::Serialize;
use serde_json::{Value, json};

use crate::Refusal;
use crate::about::About;
use crate::at::{coordinates, moving, place};
use crate::follow::follow;
use crate::limit::Stop;
use crate::machine::{Machine, prepared};
use crate::motion::Followed;
use crate::picture::{Film, Moved};
use crate::question::{At, Question, Show};
use crate::{circuits, motion, positions, report, sheet, simulate};

/// The compiled text, and the motion that was followed last.
#[derive(Default)]
pub struct Session {
    #[cfg_attr(not(feature = "compiler"), expect(dead_code, reason = "without the compiler there is no text"))]
    text: String,
    machines: Vec<Machine>,
    followed: Option<Followed>,
}

impl Session {
    /// The answer to a question, both in JSON; a long one says how far it is, from 0 to 1.
    pub fn ask(&mut self, question: &str, progress: &mut dyn FnMut(f64)) -> String {
        let answer = match serde_json::from_str(question) {
            Ok(question) => self.answer(question, progress),
            Err(error) => Err(Refusal::new(format!("the question is not read: {error}"))),
        };
        let written = match answer {
            Ok(answer) => serde_json::to_string(&answer),
            Err(refusal) => serde_json::to_string(&refusal),
        };
        // All keys are texts.
        written.unwrap_or_default()
    }

    fn answer(&mut self, question: Question, progress: &mut dyn FnMut(f64)) -> Result<Value, Refusal> {
        match question {
            Question::Compile { text } => Ok(self.compile(text)),
            Question::Load { written } => {
                self.machines = Machine::all(&written)?;
                self.followed = None;
                Ok(self.mechanisms())
            }
            Question::Words => words(),
            Question::Begin { mechanism, parameters, near, show } => {
                let design = self.machine(mechanism)?.design(&parameters);
                let prepared = prepared(&design)?;
                let moving = moving(&prepared)?;
                let machine = self.machine(mechanism)?;
                let q = positions::begin(machine, &moving, &design, near.as_ref())
                    .map_err(|why| machine.explained(why, &parameters))?;
                self.moved(At { mechanism, parameters, place: place(&q) }, show, None)
            }
            Question::Positions { mechanism, parameters, inputs } => {
                let machine = self.machine(mechanism)?;
                let (positions, more) = positions::positions(machine, &parameters, &inputs)
                    .map_err(|why| machine.explained(why, &parameters))?;
                Ok(json!({ "positions": value(&positions)?, "more": more }))
            }
            Question::Picture { at, show } => self.moved(at, show, None),
            Question::Follow { at, to, show } => {
                let (at, stopped) = follow(self.machine(at.mechanism)?, at, &to)?;
                self.moved(at, show, stopped)
            }
            Question::Drag { at, joint, to, show } => self.drag(at, &joint, to, show),
            Question::Motion { at, along, rate, steps } => {
                let (followed, range) = motion::motion(self.machine(at.mechanism)?, &at, along, rate, steps)?;
                self.followed = Some(followed);
                value(&range)
            }
            Question::Chart { columns } => Ok(json!({ "svg": self.followed()?.chart(&columns)? })),
            Question::Csv => Ok(json!({ "text": self.followed()?.csv() })),
            Question::Sheet { at, rate, language, form } => {
                let text = sheet::sheet(self.machine(at.mechanism)?, &at, rate, language, form)?;
                Ok(json!({ "text": text }))
            }
            Question::Circuits { mechanism, parameters, inputs, along } => {
                value(&circuits::circuits(self.machine(mechanism)?, &parameters, &inputs, along)?)
            }
            Question::Report { at } => Ok(json!({ "html": report::report(self.machine(at.mechanism)?, &at)? })),
            Question::Rust { mechanism } => Ok(json!({ "text": self.rust(mechanism)? })),
            Question::Simulate(asked) => {
                value(&simulate::simulate(self.machine(asked.at.mechanism)?, &asked, progress)?)
            }
        }
    }

    #[cfg(feature = "compiler")]
    fn compile(&mut self, text: String) -> Value {
        match crate::text::compile(&text) {
            Ok(machines) => {
                (self.text, self.machines, self.followed) = (text, machines, None);
                self.mechanisms()
            }
            Err(mistakes) => json!({ "mistakes": mistakes }),
        }
    }

    #[cfg(not(feature = "compiler"))]
    fn compile(&mut self, _: String) -> Value {
        json!({ "why": NO_COMPILER })
    }

    #[cfg(feature = "compiler")]
    fn rust(&self, mechanism: usize) -> Result<String, Refusal> {
        crate::text::rust(&self.text, &self.machine(mechanism)?.about.name)
    }

    #[cfg(not(feature = "compiler"))]
    fn rust(&self, _: usize) -> Result<String, Refusal> {
        Err(Refusal::new(NO_COMPILER))
    }

    fn mechanisms(&self) -> Value {
        let all: Vec<&About> = self.machines.iter().map(|machine| &machine.about).collect();
        json!({ "mechanisms": all })
    }

    fn machine(&self, place: usize) -> Result<&Machine, Refusal> {
        self.machines.get(place).ok_or_else(|| Refusal::new("there is no such mechanism"))
    }

    fn followed(&self) -> Result<&Followed, Refusal> {
        self.followed.as_ref().ok_or_else(|| Refusal::new("no motion was followed"))
    }

    /// The picture of a position.
    fn moved(&self, at: At, show: Show, stopped: Option<Stop>) -> Result<Value, Refusal> {
        let machine = self.machine(at.mechanism)?;
        let design = machine.design(&at.parameters);
        let prepared = prepared(&design)?;
        let mechanism = moving(&prepared)?;
        let q = coordinates(&mechanism, &at.place)?;
        let followed = self.followed.as_ref().filter(|followed| followed.of.0 == at.mechanism);
        let film = followed.and_then(|followed| {
            let is_current = followed.of.1 == at.parameters && followed.along == show.along;
            Some(Film { frames: followed.film.as_ref()?, is_current })
        });
        let mut moved = Moved::of((&machine.about, &mechanism), at, &q, show, film)?;
        moved.stopped = stopped;
        value(&moved)
    }

    /// Moves the input by Gauss-Newton steps, until the joint is as near to the place as it comes.
    fn drag(&self, at: At, joint: &str, to: [f64; 2], show: Show) -> Result<Value, Refusal> {
        let machine = self.machine(at.mechanism)?;
        let design = machine.design(&at.parameters);
        let prepared = prepared(&design)?;
        let mechanism = moving(&prepared)?;
        let (place, stopped) = crate::drag::drag(&mechanism, &at.place, show.along, joint, to)?;
        self.moved(At { place, ..at }, show, stopped)
    }
}

#[cfg(not(feature = "compiler"))]
const NO_COMPILER: &str = "this module runs mechanisms that were compiled before";

#[cfg(feature = "compiler")]
fn words() -> Result<Value, Refusal> {
    value(&crate::text::words())
}

#[cfg(not(feature = "compiler"))]
fn words() -> Result<Value, Refusal> {
    Err(Refusal::new(NO_COMPILER))
}

fn value(answer: &impl Serialize) -> Result<Value, Refusal> {
    serde_json::to_value(answer).map_err(Refusal::new)
}
