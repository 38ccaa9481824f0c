//! A figure as SVG or PNG, by the `plotters` crate.
//!
//! The command brings its own font, so that no library or font of the system is asked for: PNG is
//! written in it; in SVG it takes the measure, and the viewer has the choice. plotters rounds to whole pixels: SVG is drawn on a grid ten times as
//! fine, PNG on one four times as fine, and averaged.

use super::figure::{Axes, Axis, Color, Figure, Mark, Panel, Part, equalised};
use crate::preview::Image;
use carvel::{Error, ErrorKind, Result};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{Color as _, FontStyle, register_font};
use std::fmt::Display;
use std::io;

/// Steps of plotters' grid per pixel of an SVG.
const SVG_GRID: u32 = 10;
/// The same for a PNG.
const PNG_GRID: u32 = 4;
/// The name that both back ends know the font by.
const FONT: &str = "sans-serif";
/// The lines of a graph's grid, and its axes.
const LINES: RGBColor = RGBColor(228, 228, 228);
const AXES: RGBColor = RGBColor(90, 90, 90);
/// The most pixels on a side.
const LARGEST: u32 = 1 << 13;

/// The formats of plots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Scalable.
    Svg,
    /// Pixels.
    Png,
}

/// Draws a figure.
///
/// # Errors
/// `TooLarge` for a figure of more than 8,192 pixels on a side, `OutOfResources`, and `Io` if a
/// picture cannot be encoded.
pub fn render(figure: &Figure, kind: Kind) -> Result<Vec<u8>> {
    let rows = figure.panels.len().div_ceil(figure.columns.max(1));
    let side = |n: usize, pixels: u32| u32::try_from(n).ok()?.checked_mul(pixels);
    let sides = side(figure.columns, figure.size[0]).zip(side(rows, figure.size[1]));
    let sides = sides.filter(|&(width, height)| width.max(height) <= LARGEST);
    let (width, height) = sides.ok_or_else(|| {
        let message = format!("{} panels in one picture", figure.panels.len());
        Error::new(ErrorKind::TooLarge, message)
    })?;
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| failed("the font cannot be read"))?;
    match kind {
        Kind::Svg => svg(figure, width, height),
        Kind::Png => png(figure, width, height),
    }
}

fn svg(figure: &Figure, width: u32, height: u32) -> Result<Vec<u8>> {
    let (wide, high) = (width * SVG_GRID, height * SVG_GRID);
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, (wide, high)).into_drawing_area();
    panels(&root, figure, SVG_GRID)?;
    drop(root);
    // The grid stays in the view box.
    let (grid, pixels) = (
        format!("width=\"{wide}\" height=\"{high}\""),
        format!("width=\"{width}\" height=\"{height}\""),
    );
    Ok(text.replacen(&grid, &pixels, 1).into_bytes())
}

fn png(figure: &Figure, width: u32, height: u32) -> Result<Vec<u8>> {
    let (wide, high) = (width * PNG_GRID, height * PNG_GRID);
    let mut pixels = Vec::new();
    let bytes = wide as usize * high as usize * 3;
    pixels.try_reserve_exact(bytes).map_err(|_| {
        let message = format!("no memory for a picture of {wide}x{high} pixels");
        Error::new(ErrorKind::OutOfResources, message)
    })?;
    pixels.resize(bytes, 0_u8);
    let root = BitMapBackend::with_buffer(&mut pixels, (wide, high)).into_drawing_area();
    panels(&root, figure, PNG_GRID)?;
    drop(root);
    averaged(&pixels, width, height)?.encode_png()
}

/// The picture of a fine grid's pixels.
fn averaged(pixels: &[u8], width: u32, height: u32) -> Result<Image> {
    let mut image = Image::blank(width, height, [255; 4])?;
    let (rows, columns) = (PNG_GRID as usize, PNG_GRID as usize);
    let area = PNG_GRID * PNG_GRID;
    let line = width as usize * columns * 3;
    for (y, band) in (0..height).zip(pixels.chunks_exact(line * rows)) {
        for (x, out) in image.row_mut(y).iter_mut().enumerate() {
            for (k, byte) in out[..3].iter_mut().enumerate() {
                let at =
                    |i: usize| band[(i / columns) * line + (x * columns + i % columns) * 3 + k];
                let sum: u32 = (0..rows * columns).map(|i| u32::from(at(i))).sum();
                *byte = ((sum + area / 2) / area) as u8;
            }
        }
    }
    Ok(image)
}

type Area<B> = DrawingArea<B, Shift>;

fn failed(reason: impl Display) -> Error {
    Error::io("drawing the plot", io::Error::other(reason.to_string()))
}

fn panels<B: DrawingBackend>(root: &Area<B>, figure: &Figure, grid: u32) -> Result<()> {
    root.fill(&WHITE).map_err(failed)?;
    let rows = figure.panels.len().div_ceil(figure.columns.max(1));
    let areas = root.split_evenly((rows, figure.columns));
    figure.panels.iter().zip(&areas).try_for_each(|(panel, area)| draw(panel, area, grid))?;
    root.present().map_err(failed)
}

fn draw<B: DrawingBackend>(panel: &Panel, area: &Area<B>, grid: u32) -> Result<()> {
    let (margin, title) = (8 * grid, if panel.title.is_empty() { 0 } else { 20 * grid });
    let (width, height) = area.dim_in_pixel();
    let inside = [width.saturating_sub(2 * margin), height.saturating_sub(2 * margin + title)];
    let [x, y] = match panel.axes {
        Axes::Shape => equalised(panel.bounds(), inside),
        Axes::Graph { .. } => panel.bounds(),
    };
    let mut builder = ChartBuilder::on(area);
    builder.margin(margin);
    if title > 0 {
        builder.caption(&panel.title, (FONT, 13 * grid));
    }
    if let Axes::Graph { .. } = panel.axes {
        builder.x_label_area_size(34 * grid).y_label_area_size(48 * grid);
    }
    let mut chart = builder.build_cartesian_2d(x[0]..x[1], y[0]..y[1]).map_err(failed)?;
    if let Axes::Graph { x, y } = panel.axes {
        draw_axes(&mut chart, [x, y], grid)?;
    }
    panel.parts.iter().try_for_each(|part| draw_part(&mut chart, part, grid))?;
    let named = panel.parts.iter().any(|part| part.name.is_some());
    if named { draw_key(&mut chart, grid) } else { Ok(()) }
}

type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

fn draw_axes<B: DrawingBackend>(chart: &mut Chart<B>, [x, y]: [Axis; 2], grid: u32) -> Result<()> {
    let (across, up) = (|value: &f64| label(x, *value), |value: &f64| label(y, *value));
    let mut mesh = chart.configure_mesh();
    mesh.x_labels(9).y_labels(7).x_desc(x.name()).y_desc(y.name());
    mesh.x_label_formatter(&across).y_label_formatter(&up);
    mesh.label_style((FONT, 11 * grid)).axis_desc_style((FONT, 12 * grid));
    mesh.light_line_style(TRANSPARENT).bold_line_style(LINES.stroke_width(grid));
    mesh.axis_style(AXES.stroke_width(grid)).set_all_tick_mark_size(4 * grid);
    mesh.draw().map_err(failed)
}

fn draw_part<'a, B: DrawingBackend + 'a>(
    chart: &mut Chart<'a, B>,
    part: &Part,
    grid: u32,
) -> Result<()> {
    let (style, points) = (style(part, grid), finite(part));
    let drawn = match part.mark {
        Mark::Nothing => return Ok(()),
        Mark::Line(_) => chart.draw_series([PathElement::new(points, style)]),
        Mark::Dots(radius) => {
            let radius = (radius * f64::from(grid)).round();
            let dot = |point| Circle::new(point, radius, style.color.filled());
            chart.draw_series(points.into_iter().map(dot))
        }
        Mark::Face => {
            let outline: Vec<_> = points.iter().chain(points.first()).copied().collect();
            let inside = Polygon::new(points, style.color.filled());
            chart.draw_series([inside]).map_err(failed)?;
            let edge = rgb(part.color.map(|byte| byte / 2)).stroke_width(style.stroke_width);
            chart.draw_series([PathElement::new(outline, edge)])
        }
    };
    let drawn = drawn.map_err(failed)?;
    if let Some(name) = &part.name {
        let wide = 18 * grid as i32;
        drawn
            .label(name)
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + wide, y)], style));
    }
    Ok(())
}

/// The key goes where graphs of even functions and spectra leave room.
fn draw_key<'a, B: DrawingBackend + 'a>(chart: &mut Chart<'a, B>, grid: u32) -> Result<()> {
    let mut key = chart.configure_series_labels();
    key.label_font((FONT, 11 * grid)).legend_area_size(26 * grid).margin(6 * grid);
    key.position(SeriesLabelPosition::UpperMiddle).background_style(WHITE.mix(0.8));
    key.draw().map_err(failed)
}

/// The number beside a tick; none between those that count.
fn label(axis: Axis, value: f64) -> String {
    // Ticks are sums of steps; beyond this digit they are rounding. 0 has no sign.
    let value = (value * 1e6).round() / 1e6 + 0.0;
    match axis {
        Axis::Count(_) if value.fract() != 0.0 => String::new(),
        _ => value.to_string(),
    }
}

fn rgb([r, g, b]: Color) -> RGBColor {
    RGBColor(r, g, b)
}

fn style(part: &Part, grid: u32) -> ShapeStyle {
    let width = match part.mark {
        Mark::Line(width) => width,
        Mark::Dots(radius) => radius,
        Mark::Face => 0.5,
        Mark::Nothing => 0.0,
    };
    rgb(part.color).stroke_width((width * f64::from(grid)).round().max(1.0) as u32)
}

/// The points that can be shown.
fn finite(part: &Part) -> Vec<(f64, f64)> {
    let finite = |point: &&[f64; 2]| point.iter().all(|x| x.is_finite());
    part.points.iter().filter(finite).map(|&[x, y]| (x, y)).collect()
}
