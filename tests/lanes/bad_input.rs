//! Columns that do not fit, lanes that do not exist, and rejected lanes with their errors.

use linkage::lanes::{Lanes, Values};
use linkage::{Elbow, InputError, PositionError};
use linkage_gallery::norton_four_bar::{NortonFourBar, NortonFourBarBranch, NortonFourBarColumns, NortonFourBarInputs};

type Batch<'a> = linkage::lanes::Batch<'a, NortonFourBar>;

fn inputs(angles: &[f64]) -> Result<Batch<'_>, InputError> {
    let branch = NortonFourBarBranch::new(Elbow::Left);
    NortonFourBar::batch(
        NortonFourBar::default(),
        NortonFourBarInputs { theta2: angles },
        branch,
        1.0.into(),
        0.0.into(),
    )
}

/// The parameters, each as one number for all lanes.
fn same(design: NortonFourBar) -> NortonFourBar<Values<'static, f64>> {
    let NortonFourBar { a, b, c, d } = design;
    NortonFourBar { a: Values::Same(a), b: Values::Same(b), c: Values::Same(c), d: Values::Same(d) }
}

#[test]
fn columns_of_different_lengths() {
    let lengths = [39.0, 40.0, 41.0];
    let design = NortonFourBar { a: Values::Each(&lengths), ..same(NortonFourBar::default()) };
    let branch = NortonFourBarBranch::new(Elbow::Left);
    let start = NortonFourBarInputs { theta2: [0.1, 0.2].as_slice() };
    let error = NortonFourBar::batch(design, start, branch, 1.0.into(), 0.0.into()).unwrap_err();
    assert_eq!(
        error,
        InputError::ColumnLength { mechanism: "NortonFourBar", column: "theta2", length: 2, expected: 3 }
    );
    assert_eq!(error.to_string(), "the column theta2 of a batch of NortonFourBar has 2 entries instead of 3");
}

#[test]
fn results_of_another_length() {
    let batch = inputs(&[0.1, 0.2, 0.3]).unwrap();
    let of_length = |column, length, expected| {
        Err(InputError::ColumnLength { mechanism: "NortonFourBar", column, length, expected })
    };
    let (mut short, mut accepted) = ([0.0; 2], [false; 3]);
    let list = NortonFourBarColumns { theta3_rate: Some(&mut short[..]), ..Default::default() }.list();
    assert_eq!(batch.run(&mut { list }, &mut accepted), of_length("theta3_rate", 2, 3));
    assert_eq!(batch.run(&mut NortonFourBarColumns::default().list(), &mut [false; 4]), of_length("accepted", 4, 3));
    assert_eq!(batch.run(&mut [], &mut accepted), of_length("found columns", 0, NortonFourBar::<f64>::FOUND.len()));
}

#[test]
fn a_lane_that_does_not_exist() {
    let error = inputs(&[0.1, 0.2, 0.3]).unwrap().lane(3).unwrap_err();
    assert!(matches!(error, PositionError::Input(InputError::OutOfRange { value: 3.0, most: 2.0, .. })), "{error:?}");
    let error = inputs(&[]).unwrap().lane(0).unwrap_err();
    assert!(matches!(error, PositionError::Input(InputError::OutOfRange { .. })), "{error:?}");
}

#[test]
fn no_lanes() {
    let mut column = [];
    let list = NortonFourBarColumns { theta3: Some(&mut column[..]), ..Default::default() }.list();
    assert_eq!(inputs(&[]).unwrap().run(&mut { list }, &mut []), Ok(0));
}

#[test]
fn rejected_lanes_are_not_a_number_and_have_their_errors() {
    let lengths = [40.0, 1e4, f64::NAN, 0.0, 40.0];
    let design = NortonFourBar { a: Values::Each(&lengths), ..same(NortonFourBar::default()) };
    let branch = NortonFourBarBranch::new(Elbow::Left);
    let batch = NortonFourBar::batch(design, 0.7.into(), branch, 1.0.into(), 0.0.into()).unwrap();
    let (mut angles, mut accepted) = ([0.0; 5], [false; 5]);
    let list = NortonFourBarColumns { theta3: Some(&mut angles[..]), ..Default::default() }.list();
    assert_eq!(batch.run(&mut { list }, &mut accepted), Ok(2));
    assert_eq!(accepted, [true, false, false, true, true]);
    assert_eq!(angles.map(f64::is_nan), [false, true, true, false, false]);
    assert!(matches!(batch.lane(1), Err(PositionError::Unbuildable { .. })), "{:?}", batch.lane(1));
    assert!(matches!(batch.lane(2), Err(PositionError::NotFinite { .. })), "{:?}", batch.lane(2));
}

#[test]
fn one_number_for_all_lanes_is_one_lane() {
    let branch = NortonFourBarBranch::new(Elbow::Left);
    let batch = NortonFourBar::batch(NortonFourBar::default(), 0.7.into(), branch, 1.0.into(), 0.0.into()).unwrap();
    let (mut rate, mut accepted) = ([0.0], [false]);
    let list = NortonFourBarColumns { theta3_rate: Some(&mut rate[..]), ..Default::default() }.list();
    assert_eq!((batch.count(), batch.run(&mut { list }, &mut accepted)), (1, Ok(0)));
    let alone = NortonFourBar::default().kinematics(0.7, branch, 1.0, 0.0).unwrap();
    assert_eq!((rate[0], accepted[0]), (alone.rates.theta3, true));
}
