//! One mask a row: a row is accepted if its position, its rates and its accelerations exist, and a quantity that does not
//! exist is missing in its own column. So each reducer gives the same alone, in a tuple, and by a search of all columns.

use crate::common::{bits, go_on};
use linkage::linkage;
use linkage_runtime::PositionError;
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{
    Best, Case, Column, Extremes, Front, Histogram, Kind, Place, Plan, Ranked, Rejected, Sweep, found, given,
};

linkage! {
    /// A slider-crank, computed in lanes, that cannot be assembled everywhere and whose outputs have limited domains.
    #[derive(Debug, Clone)]
    pub mechanism Press {
        param r = 2, l = 3, h = 1;
        input th;
        unknown phi, s;
        loop r@th + l@phi = (s, h);
        point P = (sqrt(s - 2), h);
        output root = sqrt(cos(th));
        output steep = 1 / (s - 4);
        output mu = phi;
        derive lanes;
    }

    /// Its outputs need functions of a library, so that rows are computed one by one.
    #[derive(Debug, Clone)]
    pub mechanism Arc {
        param r = 2, l = 3, h = 1;
        input th;
        unknown phi, s;
        loop r@th + l@phi = (s, h);
        output root = acos(s - 3);
        output level = ln(s - 2);
        derive lanes;
    }
}

/// Cranks that turn fully and such that do not, each at 60 positions. The crank turns at 1 rad/s.
fn sweep<M: Lanes<Scalar = f64> + Default>(branch: M::Branch) -> Sweep<M> {
    let plan = Plan::new().grid("r", 1.0, 3.0, 7).turn("th", 60).constant("th_rate", 1.0);
    Sweep::new(&M::default(), branch, plan).unwrap().with_case(1).unwrap()
}

fn press() -> Sweep<Press> {
    sweep(PressBranch::all().next().unwrap())
}

fn arc() -> Sweep<Arc> {
    sweep(ArcBranch::all().next().unwrap())
}

/// All found columns and the mask.
fn all<M: Lanes<Scalar = f64> + Clone>(sweep: &Sweep<M>) -> (Vec<Vec<f64>>, Vec<bool>) {
    let columns: Vec<Column> = (0..M::FOUND.len()).map(found).collect();
    let sweep = sweep.clone().with_rows_per_chunk(usize::MAX).unwrap();
    let chunk = sweep.chunk(0, &columns).unwrap();
    let values = chunk.columns().map(|(_, _, values)| values.to_vec()).collect();
    (values, chunk.accepted().to_vec())
}

fn the_mask_does_not_depend_on_the_columns<M: Lanes<Scalar = f64> + Clone>(sweep: &Sweep<M>)
where
    M::Branch: Send + Sync,
{
    let (values, mask) = all(sweep);
    let rejected = mask.iter().filter(|accepted| !**accepted).count();
    assert!(rejected > 30 && rejected < mask.len() / 2, "{rejected}");
    let whole = sweep.clone().with_rows_per_chunk(usize::MAX).unwrap();
    let mut partly = 0;
    for (column, values) in values.iter().enumerate() {
        let chunk = whole.chunk(0, &[found(column), given(0)]).unwrap();
        assert_eq!(chunk.accepted(), mask, "{}", M::FOUND[column]);
        assert_eq!(chunk.rejected(), rejected);
        assert_eq!(bits(chunk.column(Place::Found(column)).unwrap()), bits(values), "{}", M::FOUND[column]);
        let exists: Vec<bool> = chunk.mask(Place::Found(column)).unwrap().collect();
        assert!(exists.iter().zip(values).all(|(exists, value)| if *exists {
            value.is_finite()
        } else {
            value.is_nan()
        }));
        assert!(exists.iter().zip(&mask).all(|(exists, accepted)| *accepted || !exists));
        assert!(chunk.mask(Place::Given(0)).unwrap().all(|exists| exists));
        assert!(chunk.mask(Place::Given(1)).is_none());
        partly += usize::from(exists != mask);
    }
    assert!(partly >= 4 && partly < values.len(), "{partly} columns have masks of their own");
    for (row, accepted) in mask.iter().enumerate() {
        assert_eq!(sweep.rejection(row as u64).unwrap().is_none(), *accepted, "{row}");
    }
    // A quantity that overflows is no reason either.
    let kinds = sweep.reduce(&Rejected, go_on).unwrap().kinds;
    assert!(kinds.iter().all(|kind| kind.kind != Kind::NotFinite && kind.error.is_some()), "{kinds:?}");
    assert_eq!(kinds.iter().map(|kind| kind.count).sum::<u64>(), rejected as u64);
}

#[test]
fn the_mask_does_not_depend_on_the_columns_asked_for() {
    the_mask_does_not_depend_on_the_columns(&press());
    the_mask_does_not_depend_on_the_columns(&arc());
}

#[test]
fn a_row_is_rejected_for_its_position_only() {
    let reason = |row| press().rejection(row).unwrap();
    // The longest crank, straight down: it does not reach. The shortest at half a turn: root does not exist.
    assert!(matches!(reason(6 * 60 + 45), Some(PositionError::Unbuildable { .. })));
    assert_eq!(reason(30), None);
    let chunk = press().chunk(0, &[found("root")]).unwrap();
    assert!(chunk.accepted()[30] && chunk.columns().next().unwrap().2[30].is_nan());
}

/// The largest number of a case, of those that exist.
fn top(case: &Case<'_, f64, 1>) -> Option<f64> {
    case.numbers(0).reduce(f64::max)
}

fn spread(case: &Case<'_, f64, 2>) -> Option<[f64; 2]> {
    Some([case.numbers(0).reduce(f64::max)?, -case.numbers(1).reduce(f64::min)?])
}

/// All reducers of a column alone, in a tuple with those of other columns, and by a search.
fn reducers_agree<M: Lanes<Scalar = f64> + Clone>(sweep: &Sweep<M>)
where
    M::Branch: Send + Sync,
{
    let (values, mask) = all(sweep);
    for (column, values) in values.iter().enumerate() {
        let name = M::FOUND[column];
        let existing = || values.iter().enumerate().filter(|(row, value)| mask[*row] && value.is_finite());
        let other = found((column + 5) % M::FOUND.len());
        let extremes = Extremes::of(found(column));
        let histogram = Histogram::of(found(column), -1.0, 2.0, 12);
        let best = Best::new(4, [found(column)], top);
        let front = Front::new([found(column), other.clone()], spread);
        let alone = (
            sweep.reduce(&extremes, go_on).unwrap(),
            sweep.reduce(&histogram, go_on).unwrap(),
            sweep.reduce(&best, go_on).unwrap(),
            sweep.reduce(&front, go_on).unwrap(),
            sweep.reduce(&Rejected, go_on).unwrap(),
        );
        for (rows, threads) in [(1, 1), (60, 2), (1000, 3)] {
            let sweep = sweep.clone().with_rows_per_chunk(rows).unwrap().with_threads(threads).unwrap();
            let every: Vec<Extremes> = (0..M::FOUND.len()).map(|column| Extremes::of(found(column))).collect();
            let tuple = (
                extremes.clone(),
                histogram.clone(),
                Best::new(4, [found(column)], top),
                Front::new([found(column), other.clone()], spread),
                Rejected,
                every,
            );
            let (a, b, c, d, e, _) = sweep.reduce(&tuple, go_on).unwrap();
            assert_eq!((a, b, c, d, e), alone, "{name}");
        }
        let least = existing().min_by(|a, b| a.1.partial_cmp(b.1).unwrap());
        let found_least = alone.0.least.map(|least| (least.row as usize, least.value));
        assert_eq!(found_least, least.map(|(row, value)| (row, *value)), "{name}");
        assert_eq!(alone.1.total(), existing().count() as u64, "{name}");
        let below = existing().filter(|(_, value)| **value < -1.0).count() as u64;
        assert_eq!(alone.1.below, below, "{name}");
        let mut ranked: Vec<Ranked> = (0..7)
            .filter_map(|case| {
                let rows = existing().filter(|(row, _)| row / 60 == case).map(|(_, value)| *value);
                Some(Ranked { score: rows.reduce(f64::max)?, case: case as u64, first_row: 60 * case as u64 })
            })
            .collect();
        ranked.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.case.cmp(&b.case)));
        ranked.truncate(4);
        assert_eq!(alone.2, ranked, "{name}");
        assert_eq!(alone.4.total(), mask.iter().filter(|accepted| !**accepted).count() as u64);
    }
}

#[test]
fn each_reducer_gives_the_same_alone_and_in_a_tuple() {
    reducers_agree(&press());
    reducers_agree(&arc());
}

#[test]
fn a_case_knows_its_numbers_that_exist() {
    let sweep = press().with_rows_per_chunk(usize::MAX).unwrap();
    let chunk = sweep.chunk(0, &[found("root"), found("mu")]).unwrap();
    let [root, mu] = ["root", "mu"].map(|name| found(name).place::<Press>().unwrap());
    let mut complete = 0;
    for case in sweep.block(&chunk).cases([mu, root]) {
        let accepted = case.accepted.iter().filter(|accepted| **accepted).count();
        assert_eq!(case.numbers(0).count(), accepted);
        assert!(case.numbers(1).count() < accepted && case.numbers(2).next().is_none());
        assert!(!case.is_complete());
        let of_mu = Case { number: 0, first_row: 0, columns: [case.columns[0]], accepted: case.accepted };
        assert_eq!(of_mu.is_complete(), accepted == 60);
        complete += usize::from(of_mu.is_complete());
    }
    assert!((1..7).contains(&complete), "{complete}");
}

#[test]
fn a_number_that_does_not_exist_is_nan_in_a_file() {
    let mut text = Vec::new();
    press().write_csv_to(&mut text, &[found("mu"), found("root")], go_on).unwrap();
    let text = String::from_utf8(text).unwrap();
    let count = |ending: &str| text.lines().skip(1).filter(|line| line.ends_with(ending)).count();
    let mask = all(&press()).1;
    assert_eq!(count(",true"), mask.iter().filter(|accepted| **accepted).count());
    assert!(count(",NaN,true") > 50 && count("NaN,NaN,true") == 0);
    assert_eq!(count("NaN,NaN,false"), mask.iter().filter(|accepted| !**accepted).count());
}
