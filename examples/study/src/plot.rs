//! Line plots with logarithmic axes where asked.

use std::error::Error;
use std::path::Path;

use epaint_default_fonts::UBUNTU_LIGHT;
use plotters::coord::Shift;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged};
use plotters::prelude::*;

/// One curve; points that are not finite are left out.
pub struct Series {
    pub label: String,
    pub points: Vec<(f64, f64)>,
}

impl Series {
    pub fn new(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self {
            label: label.into(),
            points,
        }
    }
}

pub struct Plot {
    pub title: String,
    pub x: &'static str,
    pub y: &'static str,
    pub log: [bool; 2],
    pub series: Vec<Series>,
}

const SIZE: (u32, u32) = (980, 520);
/// Of the part left of the legend.
const CHART: i32 = 720;
/// Okabe and Ito's colours, that most people can tell apart.
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 0, 0),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(148, 148, 60),
];

/// Curves beyond the number of colours are thin.
fn stroke(index: usize) -> ShapeStyle {
    let width = if index < COLOURS.len() { 3 } else { 1 };
    COLOURS[index % COLOURS.len()].stroke_width(width)
}

/// The font of the plots, for backends that draw their own text.
pub fn register_font() -> Result<(), Box<dyn Error>> {
    plotters::style::register_font("sans-serif", FontStyle::Normal, UBUNTU_LIGHT)
        .map_err(|_| "the built-in font is not a font".into())
}

impl Plot {
    /// Writes `path`.svg and, if asked, `path`.png.
    pub fn write(&self, path: &Path, png: bool) -> Result<(), Box<dyn Error>> {
        let svg = path.with_extension("svg");
        self.draw(&SVGBackend::new(&svg, SIZE).into_drawing_area())?;
        if png {
            let png = path.with_extension("png");
            self.draw(&BitMapBackend::new(&png, SIZE).into_drawing_area())?;
        }
        Ok(())
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn Error>>
    where
        B::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let (chart, legend) = area.split_horizontally(CHART);
        self.legend(&legend)?;
        let area = &chart;
        let [x, y] = [0, 1].map(|axis| self.range(axis));
        let (lx, ly) = (x.clone().log_scale(), y.clone().log_scale());
        match self.log {
            [true, true] => self.chart(area, lx, ly),
            [false, true] => self.chart(area, x, ly),
            [true, false] => self.chart(area, lx, y),
            [false, false] => self.chart(area, x, y),
        }
    }

    fn chart<B, X, Y>(&self, area: &DrawingArea<B, Shift>, x: X, y: Y) -> Result<(), Box<dyn Error>>
    where
        B: DrawingBackend,
        B::ErrorType: 'static,
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 18))
            .margin(10)
            .x_label_area_size(42)
            .y_label_area_size(70)
            .build_cartesian_2d(x, y)?;
        let format = |v: &f64| match v.abs() {
            0.0 => "0".to_string(),
            a if (0.01..10_000.0).contains(&a) => format!("{}", (v * 1e6).round() / 1e6),
            _ => format!("{v:.0e}"),
        };
        chart
            .configure_mesh()
            .x_desc(self.x)
            .y_desc(self.y)
            .light_line_style(BLACK.mix(0.04))
            .bold_line_style(BLACK.mix(0.12))
            .x_label_formatter(&format)
            .y_label_formatter(&format)
            .label_style(("sans-serif", 14))
            .draw()?;
        for (index, series) in self.series.iter().enumerate() {
            let points: Vec<_> = series
                .points
                .iter()
                .copied()
                .filter(|p| self.shown(*p))
                .collect();
            chart.draw_series(LineSeries::new(points.iter().copied(), stroke(index)))?;
            if points.len() < 30 {
                chart.draw_series(
                    points
                        .iter()
                        .map(|&p| Circle::new(p, 3, COLOURS[index % COLOURS.len()].filled())),
                )?;
            }
        }
        area.present()?;
        Ok(())
    }

    fn legend<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn Error>>
    where
        B::ErrorType: 'static,
    {
        for (index, series) in self.series.iter().enumerate() {
            let y = 48 + 20 * index as i32;
            area.draw(&PathElement::new([(4, y), (26, y)], stroke(index)))?;
            let style = ("sans-serif", 14);
            area.draw(&Text::new(series.label.as_str(), (32, y - 7), style))?;
        }
        Ok(())
    }

    fn shown(&self, (x, y): (f64, f64)) -> bool {
        let fits = |v: f64, log: bool| v.is_finite() && (!log || v > 0.0);
        fits(x, self.log[0]) && fits(y, self.log[1])
    }

    fn range(&self, axis: usize) -> std::ops::Range<f64> {
        let all = self
            .series
            .iter()
            .flat_map(|s| &s.points)
            .copied()
            .filter(|p| self.shown(*p));
        let values: Vec<f64> = all.map(|(x, y)| if axis == 0 { x } else { y }).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match (low <= high, self.log[axis]) {
            (false, true) => 0.1..1.0,
            (false, false) => 0.0..1.0,
            (true, true) => low / 1.3..(high * 1.3).max(low * 2.0),
            (true, false) => {
                let pad = 0.03 * (high - low).max(1e-12);
                low - pad..high + pad
            }
        }
    }
}
