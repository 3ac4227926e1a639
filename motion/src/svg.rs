//! A picture of plane curves as SVG: equal scale on both axes, y up, a grid labelled in mm, markers, a legend.
//! Knows nothing of machines: other modules add curves to it.
//!
//! `Picture::new("plate").curve("commanded", points, Stroke::feed()).to_svg()`

mod frame;

use frame::{Frame, MARGIN};
use std::fmt::Write;

/// A point in mm, x to the right and y up.
pub type Point = [f64; 2];

/// How a curve looks.
#[derive(Clone, PartialEq, Debug)]
pub struct Stroke {
    /// CSS colour.
    pub colour: String,
    /// Line width in pixels.
    pub width: f64,
    /// Dashed.
    pub dashed: bool,
}

impl Stroke {
    /// Solid, of a colour.
    pub fn solid(colour: &str, width: f64) -> Self {
        Stroke { colour: colour.to_owned(), width, dashed: false }
    }
    /// Dashed, of a colour.
    pub fn dashed(colour: &str, width: f64) -> Self {
        Stroke { dashed: true, ..Stroke::solid(colour, width) }
    }
    /// Feed moves.
    pub fn feed() -> Self {
        Stroke::solid("#0b62a4", 2.0)
    }
    /// Traverses.
    pub fn rapid() -> Self {
        Stroke::dashed("#d2691e", 1.2)
    }
    /// A measured or simulated path over a commanded one.
    pub fn actual() -> Self {
        Stroke::solid("#c2185b", 1.0)
    }
}

struct Curve {
    name: String,
    points: Vec<Point>,
    stroke: Stroke,
}

struct Marker {
    name: String,
    at: Point,
    colour: String,
}

/// Curves and markers to draw. Curves of the same name share a legend entry.
pub struct Picture {
    title: String,
    axes: [String; 2],
    curves: Vec<Curve>,
    markers: Vec<Marker>,
}

/// Height of a legend row in pixels.
const ROW: f64 = 20.0;

impl Picture {
    /// An empty picture.
    pub fn new(title: impl Into<String>) -> Self {
        Picture { title: title.into(), axes: ["X".into(), "Y".into()], curves: Vec::new(), markers: Vec::new() }
    }

    /// Names of the horizontal and the vertical axis.
    pub fn axes(mut self, horizontal: &str, vertical: &str) -> Self {
        self.axes = [horizontal.to_owned(), vertical.to_owned()];
        self
    }

    /// Adds a curve through `points` (mm). Points that are not finite are left out.
    pub fn curve(mut self, name: &str, points: impl IntoIterator<Item = Point>, stroke: Stroke) -> Self {
        let points: Vec<Point> = points.into_iter().filter(|p| p[0].is_finite() && p[1].is_finite()).collect();
        if !points.is_empty() {
            self.curves.push(Curve { name: name.to_owned(), points, stroke });
        }
        self
    }

    /// Adds a dot with a name (mm).
    pub fn marker(mut self, name: &str, at: Point, colour: &str) -> Self {
        if at[0].is_finite() && at[1].is_finite() {
            self.markers.push(Marker { name: name.to_owned(), at, colour: colour.to_owned() });
        }
        self
    }

    /// The picture as the text of an SVG file.
    pub fn to_svg(&self) -> String {
        let frame = Frame::around(self);
        let [left, top, right, bottom] = MARGIN;
        let width = frame.width + left + right;
        let (legend, rows) = laid_out(self.legend(), frame.width);
        let height = frame.height + top + bottom + ROW * rows;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        );
        self.draw_title(&mut out, &frame);
        frame.draw_grid(&mut out, &self.axes);
        self.curves.iter().for_each(|c| c.draw(&mut out, &frame));
        self.draw_markers(&mut out, &frame);
        draw_legend(&mut out, &legend, &frame);
        out.push_str("</svg>\n");
        out
    }

    fn draw_title(&self, out: &mut String, frame: &Frame) {
        let x = MARGIN[0] + frame.width / 2.0;
        let title = escaped(&self.title);
        let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"28\" text-anchor=\"middle\" font-size=\"16\" fill=\"#222\">{title}</text>");
    }

    fn draw_markers(&self, out: &mut String, frame: &Frame) {
        for marker in &self.markers {
            let [x, y] = frame.place(marker.at);
            let colour = escaped(&marker.colour);
            let _ = writeln!(
                out,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4.5\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"1.2\"/>"
            );
        }
    }

    /// One entry a name, in the order added.
    fn legend(&self) -> Vec<Entry<'_>> {
        let mut entries: Vec<Entry> = Vec::new();
        for curve in &self.curves {
            if !entries.iter().any(|e| e.name == curve.name) {
                entries.push(Entry { name: &curve.name, line: Some(&curve.stroke), colour: &curve.stroke.colour });
            }
        }
        entries.extend(self.markers.iter().map(|m| Entry { name: &m.name, line: None, colour: &m.colour }));
        entries
    }
}

struct Entry<'a> {
    name: &'a str,
    line: Option<&'a Stroke>,
    colour: &'a str,
}

/// Places for the entries: column in pixels and row, both from 0; and the number of rows. Names count 7 pixels a letter.
fn laid_out(entries: Vec<Entry<'_>>, width: f64) -> (Vec<(f64, f64, Entry<'_>)>, f64) {
    let (mut x, mut row) = (0.0, 0.0);
    let mut places = Vec::new();
    for entry in entries {
        let wide = 52.0 + 7.0 * entry.name.chars().count() as f64;
        if x > 0.0 && x + wide > width {
            (x, row) = (0.0, row + 1.0);
        }
        places.push((x, row, entry));
        x += wide;
    }
    let rows = if places.is_empty() { 0.0 } else { row + 1.0 };
    (places, rows)
}

fn draw_legend(out: &mut String, entries: &[(f64, f64, Entry)], frame: &Frame) {
    let top = MARGIN[1] + frame.height + MARGIN[3] + 2.0;
    for (x, row, entry) in entries {
        let (x, y) = (MARGIN[0] + x, top + ROW * row);
        let colour = escaped(entry.colour);
        let _ = match entry.line {
            Some(stroke) => writeln!(
                out,
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\" stroke=\"{colour}\" stroke-width=\"{}\"{}/>",
                x + 26.0,
                stroke.width,
                dashes(stroke)
            ),
            None => writeln!(out, "<circle cx=\"{:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{colour}\"/>", x + 13.0),
        };
        let _ = writeln!(out, "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#222\">{}</text>", x + 32.0, y + 4.0, escaped(entry.name));
    }
}

impl Curve {
    fn draw(&self, out: &mut String, frame: &Frame) {
        let Stroke { colour, width, .. } = &self.stroke;
        let _ = write!(out, "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"", escaped(colour));
        let _ = write!(out, "{} stroke-linejoin=\"round\" stroke-linecap=\"round\" points=\"", dashes(&self.stroke));
        for (i, &point) in self.points.iter().enumerate() {
            let [x, y] = frame.place(point);
            let _ = write!(out, "{}{x:.2},{y:.2}", if i > 0 { " " } else { "" });
        }
        out.push_str("\"/>\n");
    }
}

fn dashes(stroke: &Stroke) -> &'static str {
    if stroke.dashed { " stroke-dasharray=\"6 4\"" } else { "" }
}

fn escaped(text: &str) -> String {
    let printable = text.chars().filter(|c| !c.is_control());
    printable.fold(String::new(), |mut out, c| {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            _ => out.push(c),
        }
        out
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value of an attribute of the first element that contains `mark`.
    fn attribute(svg: &str, mark: &str, name: &str) -> String {
        let line = svg.lines().find(|l| l.contains(mark)).unwrap_or_else(|| panic!("no {mark}"));
        let rest = line.split_once(&format!(" {name}=\"")).unwrap().1;
        rest.split_once('"').unwrap().0.to_owned()
    }

    #[test]
    fn scale_is_equal_and_y_points_up() {
        let svg = Picture::new("t").curve("a", [[0.0, 0.0], [200.0, 0.0], [200.0, 100.0]], Stroke::feed()).to_svg();
        let points: Vec<Point> = attribute(&svg, "<polyline", "points")
            .split(' ')
            .map(|p| p.split_once(',').map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).unwrap())
            .collect();
        let (across, up) = (points[1][0] - points[0][0], points[1][1] - points[2][1]);
        assert!((across - 2.0 * up).abs() < 0.03 && up > 0.0, "{points:?}");
    }

    #[test]
    fn same_picture_same_text_and_names_are_escaped() {
        let make = || {
            Picture::new("a < b & \"c\"")
                .curve("x>y", [[0.0, 0.0], [1.0, 1.0]], Stroke::rapid())
                .marker("s", [0.0, 0.0], "red")
                .to_svg()
        };
        assert_eq!(make(), make());
        assert!(
            make().contains("a &lt; b &amp; &quot;c&quot;") && make().contains("x&gt;y") && make().contains("stroke-dasharray")
        );
    }

    #[test]
    fn curves_of_one_name_share_a_legend_entry() {
        let curve = |p: Picture, x| p.curve("feed", [[x, 0.0], [x, 1.0]], Stroke::feed());
        let svg = curve(curve(Picture::new("t"), 0.0), 5.0).to_svg();
        assert_eq!(svg.matches(">feed</text>").count(), 1);
        assert_eq!(svg.matches("<polyline").count(), 2);
    }

    #[test]
    fn nothing_one_point_and_bad_points_can_be_drawn() {
        for picture in [
            Picture::new(""),
            Picture::new("").curve("a", [[3.0, 4.0]], Stroke::feed()),
            Picture::new("").curve("a", [[f64::NAN, 0.0], [1e12, 1e12], [f64::INFINITY, 0.0]], Stroke::feed()),
            Picture::new("").curve("a", [[1e12, 0.0], [1e12 + 0.001, 0.0]], Stroke::feed()),
        ] {
            let svg = picture.to_svg();
            assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}
