//! The distribution of a column.

use linkage_runtime::lanes::Lanes;
use linkage_runtime::nalgebra::convert_unchecked;

use super::Reducer;
use crate::count::{filled, positive};
use crate::{Block, Column, Place, SweepError, bind};

/// Counts the numbers of a column in the accepted rows in which it exists, in bins of equal width.
#[derive(Debug, Clone)]
pub struct Histogram {
    column: Column,
    from: f64,
    to: f64,
    bins: usize,
}

/// The counts of a histogram.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bins {
    /// The lower end of the first bin.
    pub from: f64,
    /// The upper end of the last bin.
    pub to: f64,
    /// The numbers in each bin. The lower end of a bin belongs to it, and the upper end to the next one; that of the
    /// last bin belongs to that bin.
    pub counts: Vec<u64>,
    /// The numbers below the first bin.
    pub below: u64,
    /// The numbers above the last bin.
    pub above: u64,
}

impl Histogram {
    /// A histogram of a column, with this number of bins over a range.
    #[must_use]
    pub fn of(column: Column, from: f64, to: f64, bins: usize) -> Self {
        Self { column, from, to, bins }
    }
}

impl Bins {
    /// The lower end of a bin, and the upper end of the one before.
    #[must_use]
    pub fn edge(&self, bin: usize) -> f64 {
        if bin == self.counts.len() {
            self.to
        } else {
            self.from + (self.to - self.from) * (bin as f64 / self.counts.len() as f64)
        }
    }

    /// The number of counted rows: those in which the column exists.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.below + self.above + self.counts.iter().sum::<u64>()
    }
}

/// Counts, with all edges of their bins.
#[derive(Debug)]
pub struct Counter {
    place: Place,
    bins: Bins,
    edges: Vec<f64>,
    /// The number of bins divided by the range.
    scale: f64,
}

impl Counter {
    fn new(place: Place, from: f64, to: f64, counts: Vec<u64>) -> Result<Self, SweepError> {
        let mut edges = filled(0.0, counts.len() + 1)?;
        let scale = counts.len() as f64 / (to - from);
        let bins = Bins { from, to, counts, below: 0, above: 0 };
        edges.iter_mut().enumerate().for_each(|(bin, edge)| *edge = bins.edge(bin));
        Ok(Self { place, bins, edges, scale })
    }

    /// Counts one number.
    fn add(&mut self, value: f64) {
        let Self { bins: Bins { from, to, counts, below, above }, edges, scale, .. } = self;
        if value > *to {
            *above += 1;
        } else if value >= *from {
            let mut bin = (((value - *from) * *scale) as usize).min(counts.len() - 1);
            // Rounding may give the bin before or after.
            while bin > 0 && value < edges[bin] {
                bin -= 1;
            }
            while bin + 1 < counts.len() && value >= edges[bin + 1] {
                bin += 1;
            }
            counts[bin] += 1;
        } else {
            *below += 1;
        }
    }
}

impl<M: Lanes> Reducer<M> for Histogram {
    type Part = Counter;
    type Output = Bins;

    fn columns(&self) -> Vec<Column> {
        vec![self.column.clone()]
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        let &Self { from, to, bins, .. } = self;
        let place = self.column.place::<M>()?;
        let name = place.name::<M>();
        bind::range::<M>(name, from, to)?;
        if from >= to {
            return Err(SweepError::EmptyRange { column: name.to_owned(), from, to });
        }
        let counts = filled(0, positive(bins, "bins")?)?;
        Counter::new(place, from, to, counts)
    }

    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
        for (_, value) in block.accepted(part.place) {
            part.add(convert_unchecked(value));
        }
    }

    fn merge(&self, part: &mut Self::Part, other: Self::Part) {
        part.bins.counts.iter_mut().zip(other.bins.counts).for_each(|(count, other)| *count += other);
        part.bins.below += other.bins.below;
        part.bins.above += other.bins.above;
    }

    fn finish(&self, part: Self::Part) -> Self::Output {
        part.bins
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_edge_belongs_to_the_bin_above_it() {
        for count in 2..200 {
            let mut counter = Counter::new(Place::Given(0), 0.1, 0.7, vec![0; count]).unwrap();
            // The inner edges, and the numbers before them.
            for bin in 1..count {
                let edge = counter.edges[bin];
                counter.add(edge);
                counter.add(edge.next_down());
            }
            let inner = counter.bins.counts.iter().take(count - 1).skip(1).all(|count| *count == 2);
            assert!(inner && counter.bins.counts[0] == 1 && counter.bins.counts[count - 1] == 1, "{count}");
        }
    }
}
