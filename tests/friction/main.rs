//! Frictions and stops: modes at one state, sliding, impacts and rest.

mod contacts;
mod event_loop;
mod over_change_points;
mod stops;
