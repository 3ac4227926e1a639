//! Scale, grid and labels of a picture.

use super::{Picture, Point, escaped};
use crate::print::number;
use std::fmt::Write;

/// Longer side of the drawing area in pixels.
const SIZE: f64 = 720.0;
/// Space around the drawing area for labels, in pixels: left, top, right, bottom.
pub const MARGIN: [f64; 4] = [64.0, 48.0, 24.0, 56.0];

/// Least width and height as a share of the longer side: room for title and legend.
const LEAST: Point = [0.5, 0.25];

/// From mm to pixels.
pub struct Frame {
    min: Point,
    max: Point,
    /// Pixels per mm.
    scale: f64,
    /// Of the drawing area in pixels.
    pub width: f64,
    /// Of the drawing area in pixels.
    pub height: f64,
}

impl Frame {
    /// Around all curves and markers, with a border; a path that is thin one way gets room.
    pub fn around(picture: &Picture) -> Self {
        let all = || picture.curves.iter().flat_map(|c| c.points.iter().copied()).chain(picture.markers.iter().map(|m| m.at));
        let (mut min, mut max) = all().next().map_or(([0.0; 2], [1.0; 2]), |p| (p, p));
        for p in all() {
            for i in 0..2 {
                min[i] = min[i].min(p[i]);
                max[i] = max[i].max(p[i]);
            }
        }
        let longest = (max[0] - min[0]).max(max[1] - min[1]);
        for i in 0..2 {
            let short = longest.max(1.0) * LEAST[i] - (max[i] - min[i]);
            let border = (longest * 0.04).max(short / 2.0).max(0.04);
            min[i] -= border;
            max[i] += border;
        }
        let scale = SIZE / (max[0] - min[0]).max(max[1] - min[1]);
        Frame { min, max, scale, width: (max[0] - min[0]) * scale, height: (max[1] - min[1]) * scale }
    }

    /// Pixels, y down.
    pub fn place(&self, p: Point) -> Point {
        [MARGIN[0] + (p[0] - self.min[0]) * self.scale, MARGIN[1] + (self.max[1] - p[1]) * self.scale]
    }

    /// Grid, labels, border, names of the axes.
    pub fn draw_grid(&self, out: &mut String, axes: &[String; 2]) {
        let [left, top, ..] = MARGIN;
        let (right, bottom) = (left + self.width, top + self.height);
        let step = grid_step(self.max[0] - self.min[0], self.max[1] - self.min[1]);
        for value in ticks(self.min[0], self.max[0], step) {
            let x = self.place([value, 0.0])[0];
            let _ =
                writeln!(out, "<line x1=\"{x:.2}\" y1=\"{top}\" x2=\"{x:.2}\" y2=\"{bottom:.2}\" stroke=\"{}\"/>", shade(value));
            let y = bottom + 16.0;
            let _ = writeln!(out, "<text x=\"{x:.2}\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"#555\">{}</text>", label(value));
        }
        for value in ticks(self.min[1], self.max[1], step) {
            let y = self.place([0.0, value])[1];
            let _ =
                writeln!(out, "<line x1=\"{left}\" y1=\"{y:.2}\" x2=\"{right:.2}\" y2=\"{y:.2}\" stroke=\"{}\"/>", shade(value));
            let (x, y) = (left - 6.0, y + 4.0);
            let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.2}\" text-anchor=\"end\" fill=\"#555\">{}</text>", label(value));
        }
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"none\" stroke=\"#999\"/>",
            self.width, self.height
        );
        self.draw_axis_names(out, axes);
    }

    fn draw_axis_names(&self, out: &mut String, axes: &[String; 2]) {
        let [left, top, ..] = MARGIN;
        let (x, y) = (left + self.width / 2.0, top + self.height + 33.0);
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"#222\">{} [mm]</text>",
            escaped(&axes[0])
        );
        let y = top + self.height / 2.0;
        let _ = writeln!(
            out,
            "<text x=\"16\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"#222\" transform=\"rotate(-90 16 {y:.1})\">{} [mm]</text>",
            escaped(&axes[1])
        );
    }
}

/// 1, 2 or 5 times a power of ten: about ten lines along the longer side.
fn grid_step(width: f64, height: f64) -> f64 {
    let wanted = width.max(height) / 10.0;
    let power = libm::pow(10.0, libm::floor(libm::log10(wanted)));
    [1.0, 2.0, 5.0].map(|m| m * power).into_iter().find(|&s| s >= wanted * 0.999).unwrap_or(10.0 * power)
}

/// Multiples of `step` from `min` to `max`; at most 100.
fn ticks(min: f64, max: f64, step: f64) -> impl Iterator<Item = f64> {
    let first = (min / step).ceil();
    (0..100u32).map(move |i| (first + f64::from(i)) * step).take_while(move |&v| v <= max)
}

fn shade(value: f64) -> &'static str {
    if value == 0.0 { "#b0b0b0" } else { "#e6e6e6" }
}

/// No zeros behind the point.
fn label(value: f64) -> String {
    number(value).trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_steps_are_round() {
        for (extent, want) in [(236.0, 50.0), (100.0, 10.0), (1.0, 0.1), (13.0, 2.0)] {
            assert!((grid_step(extent, 1.0) - want).abs() < 1e-12, "{extent}");
        }
    }
}
