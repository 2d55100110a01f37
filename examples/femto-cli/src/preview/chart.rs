//! The energies over time, drawn by `plotters`.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::sim::Energies;

/// `plotters` draws at whole pixels: it gets this many of them for one of ours.
const FINE: f64 = 4.0;

const COLOURS: [(&str, RGBColor, u32); 4] = [
    ("kinetic", RGBColor(47, 111, 179), 2),
    ("elastic", RGBColor(217, 119, 33), 2),
    ("potential, above its lowest", RGBColor(70, 145, 85), 2),
    ("total", RGBColor(35, 40, 48), 2),
];

/// An SVG fragment of the given size.
pub fn energies(points: impl Iterator<Item = (f64, Energies)>, width: f64, height: f64) -> String {
    let points: Vec<(f64, Energies)> = points.filter(|(_, e)| e.total().is_finite()).collect();
    let lowest = points
        .iter()
        .map(|(_, e)| e.potential)
        .fold(f64::INFINITY, f64::min);
    let lines: [Vec<(f64, f64)>; 4] = [
        points.iter().map(|(t, e)| (*t, e.kinetic)).collect(),
        points.iter().map(|(t, e)| (*t, e.elastic)).collect(),
        points
            .iter()
            .map(|(t, e)| (*t, e.potential - lowest))
            .collect(),
        points
            .iter()
            .map(|(t, e)| (*t, e.total() - lowest))
            .collect(),
    ];
    let size = ((width * FINE) as u32, (height * FINE) as u32);
    let mut svg = String::new();
    if draw(&mut svg, &lines, size).is_err() {
        return String::new();
    }
    // The drawing's own frame is replaced by one of the size wanted here.
    let inner = svg.split_once('>').map_or("", |(_, rest)| rest);
    format!(
        "<svg x=\"0\" y=\"0\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\">{inner}",
        size.0, size.1
    )
}

fn draw(
    svg: &mut String,
    lines: &[Vec<(f64, f64)>; 4],
    size: (u32, u32),
) -> Result<(), Box<dyn std::error::Error>> {
    let end = lines[0].last().map_or(0.0, |p| p.0);
    let highest = lines.iter().flatten().map(|p| p.1).fold(0.0, f64::max);
    let lowest = lines.iter().flatten().map(|p| p.1).fold(0.0, f64::min);
    let (unit, name) = unit(highest.max(-lowest));
    let px = |pixels: f64| (pixels * FINE) as u32;
    let grey = RGBColor(91, 102, 115);
    let font = |size: f64| ("Helvetica, Arial, 'DejaVu Sans', sans-serif", size * FINE).into_font();

    let root = SVGBackend::with_string(svg, size).into_drawing_area();
    let time = if end > 0.0 { end } else { 1.0 };
    let top = if highest > lowest {
        highest + 0.06 * (highest - lowest)
    } else {
        unit
    };
    let mut chart = ChartBuilder::on(&root)
        .margin_top(px(30.0))
        .margin_right(px(12.0))
        .x_label_area_size(px(42.0))
        .y_label_area_size(px(70.0))
        .build_cartesian_2d(0.0..time, lowest / unit..top / unit)?;
    chart
        .configure_mesh()
        .x_labels(10)
        .y_labels(7)
        .bold_line_style(RGBColor(226, 230, 235).stroke_width(px(0.8)))
        .light_line_style(TRANSPARENT)
        .axis_style(RGBColor(150, 160, 170).stroke_width(px(1.0)))
        .label_style(font(14.5).color(&grey))
        .set_all_tick_mark_size(px(4.0))
        .x_label_formatter(&|t| super::trim(tidy(*t, time)))
        .y_label_formatter(&|e| super::trim(tidy(*e, top / unit)))
        .x_desc("time (s)")
        .y_desc(format!("energy ({name})"))
        .axis_desc_style(font(15.5).color(&grey))
        .draw()?;
    for (line, (_, colour, width)) in lines.iter().zip(COLOURS) {
        if let [(t, e)] = line[..] {
            let dot = Circle::new((t, e / unit), px(3.0), colour.filled());
            chart.draw_series([dot])?;
        }
        let points = line.iter().map(|(t, e)| (*t, e / unit));
        chart.draw_series(LineSeries::new(
            points,
            colour.stroke_width(px(width.into())),
        ))?;
    }
    // The legend, in one row above the chart.
    let mut x = px(70.0) as i32;
    let y = px(14.0) as i32;
    for (name, colour, width) in COLOURS {
        let stroke = colour.stroke_width(px(f64::from(width) + 0.5));
        root.draw(&PathElement::new(
            vec![(x, y), (x + px(24.0) as i32, y)],
            stroke,
        ))?;
        let style = font(15.5)
            .color(&RGBColor(51, 61, 72))
            .pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text(name, &style, (x + px(30.0) as i32, y))?;
        x += px(30.0 + 7.0 * name.len() as f64 + 26.0) as i32;
    }
    root.present()?;
    drop(chart);
    Ok(())
}

/// Zero where rounding left almost nothing of a tick.
fn tidy(value: f64, range: f64) -> f64 {
    if value.abs() < 1e-9 * range.abs() {
        0.0
    } else {
        value
    }
}

fn unit(largest: f64) -> (f64, &'static str) {
    match largest {
        e if !(1e-9..1e12).contains(&e) => (1.0, "J"),
        e if e >= 1e9 => (1e9, "GJ"),
        e if e >= 1e6 => (1e6, "MJ"),
        e if e >= 1e3 => (1e3, "kJ"),
        e if e >= 1.0 => (1.0, "J"),
        e if e >= 1e-3 => (1e-3, "mJ"),
        e if e >= 1e-6 => (1e-6, "µJ"),
        _ => (1e-9, "nJ"),
    }
}
