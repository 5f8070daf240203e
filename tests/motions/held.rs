//! Paths and motions that own their mechanism, or share it with others.

use std::sync::Arc;
use std::thread;

use linkage::Elbow;
use linkage::PathError;
use linkage::continuation::{Along, AlongCoordinates, Direction, Options, Path, PathStep};
use linkage::range_of_motion::{MotionByLength, RangeOfMotion, RangeOptions};

linkage::linkage! {
    #[derive(Debug, Clone)]
    mechanism FourBar {
        param ground = 4, crank = 1, coupler = 3.5, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    }
}

fn start(m: &FourBar) -> FourBarCoordinates {
    m.assemble(0.5, FourBarBranch::new(Elbow::Left)).unwrap().coordinates()
}

/// A player that owns all that it plays.
struct Player {
    path: Path<'static, FourBar>,
    range: RangeOfMotion<'static, FourBar>,
    rounds: MotionByLength<'static, FourBar>,
    steps: Vec<PathStep<FourBar>>,
}

impl Player {
    fn new(m: FourBar) -> Result<Self, PathError> {
        let start = start(&m);
        Ok(Self {
            range: RangeOfMotion::on_branch(
                m.clone(),
                m.branch_of(&m.pose_at(&start)),
                [0.5],
                RangeOptions::default(),
            )?,
            rounds: MotionByLength::of(Arc::new(m.clone()), &start, RangeOptions::default())?,
            path: Path::new(m, &start, Direction::Increasing)?,
            steps: Vec::new(),
        })
    }

    fn play(mut self) -> Result<Self, PathError> {
        self.steps.push(self.path.advance_to(1.5)?);
        Ok(self)
    }
}

/// It may be returned, moved and stored while it plays, and has the digits of a path that borrows.
#[test]
fn a_struct_owns_its_path() {
    let players = [FourBar::default(), FourBar { crank: 1.25, ..FourBar::default() }];
    let players = players.map(|m| Player::new(m).and_then(Player::play).unwrap());
    for player in Vec::from(players).into_iter().rev().map(Box::new) {
        let m = player.range.driven();
        let mut borrowed = Path::new(m, &start(m), Direction::Increasing).unwrap();
        assert_eq!(player.steps, [borrowed.advance_to(1.5).unwrap()]);
        assert_eq!(player.path.position(), borrowed.position());
        let range = RangeOfMotion::of(m, &start(m), RangeOptions::default()).unwrap();
        assert_eq!(player.range.at(2.0).unwrap(), range.at(2.0).unwrap());
        let rounds = MotionByLength::of(m, &start(m), RangeOptions::default()).unwrap();
        assert_eq!(player.rounds.at(2.0).unwrap(), rounds.at(2.0).unwrap());
    }
}

/// Two threads follow one mechanism, each from another position.
#[test]
fn two_threads_share_a_mechanism() {
    let m = Arc::new(FourBar::default());
    let threads = [Direction::Increasing, Direction::Decreasing].map(|direction| {
        let mut path = Path::new(Arc::clone(&m), &start(&m), direction).unwrap();
        thread::spawn(move || path.advance_by(3.0).unwrap())
    });
    let steps = threads.map(|thread| thread.join().unwrap());
    for (step, direction) in steps.iter().zip([Direction::Increasing, Direction::Decreasing]) {
        let mut path = Path::new(&*m, &start(&m), direction).unwrap();
        assert_eq!(*step, path.advance_by(3.0).unwrap());
    }
    assert_eq!(Arc::strong_count(&m), 1);
}

/// A mechanism along a path of its inputs is held as others are.
#[test]
fn a_path_of_inputs_is_owned() {
    let m = FourBar::default();
    let q = start(&m);
    let along = move || Along { mechanism: FourBar::default(), inputs: |s: f64| [[0.5 + s * s], [2.0 * s], [2.0]] };
    let started = AlongCoordinates { q, parameter: 0.1 };
    let options = Options { range: Some([-1.0, 1.0]), ..Options::default() };
    let options = RangeOptions { path: options, ..RangeOptions::default() };
    let owned = RangeOfMotion::of(along(), &started, options).unwrap();
    let shared = RangeOfMotion::of(Arc::new(along()), &started, options).unwrap();
    assert_eq!(owned.at(0.7).unwrap(), shared.at(0.7).unwrap());
}
