//! The finished picture: pixels, strips of pictures, PNG.

use carvel::{Error, ErrorKind, Result};
use std::io;

/// A picture of sRGB pixels with straight (not premultiplied) opacity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    rgba: Vec<u8>,
}

impl Image {
    /// A picture of one colour.
    ///
    /// # Errors
    /// `OutOfResources` if there is no memory for it.
    pub fn blank(width: u32, height: u32, color: [u8; 4]) -> Result<Self> {
        let pixels = usize::try_from(u64::from(width) * u64::from(height)).ok();
        let bytes = pixels.and_then(|n| n.checked_mul(4));
        let mut rgba = Vec::new();
        if bytes.is_none_or(|n| rgba.try_reserve_exact(n).is_err()) {
            return Err(Error::new(
                ErrorKind::OutOfResources,
                format!("no memory for a picture of {width}x{height} pixels"),
            ));
        }
        rgba.extend(std::iter::repeat_n(color, pixels.unwrap_or(0)).flatten());
        Ok(Self { width, height, rgba })
    }

    /// The pixels of one row.
    pub fn row_mut(&mut self, y: u32) -> &mut [[u8; 4]] {
        let width = self.width as usize;
        &mut self.rgba.as_chunks_mut().0[y as usize * width..][..width]
    }

    /// Pictures in a row from the left, centred vertically, with `gap` pixels
    /// of `background` between them. No pictures give an empty picture.
    ///
    /// # Errors
    /// `TooLarge` if the width does not fit 32 bits, `OutOfResources` if there
    /// is no memory for it.
    pub fn beside(images: &[Self], gap: u32, background: [u8; 4]) -> Result<Self> {
        let gaps = images.len().saturating_sub(1) as u64 * u64::from(gap);
        let width = images.iter().map(|i| u64::from(i.width)).sum::<u64>() + gaps;
        let width = u32::try_from(width).map_err(|_| {
            Error::new(ErrorKind::TooLarge, format!("a strip of pictures {width} pixels wide"))
        })?;
        let height = images.iter().map(|i| i.height).max().unwrap_or(0);
        let mut strip = Self::blank(width, height, background)?;
        let mut left = 0;
        for image in images {
            strip.paste(image, left, (height - image.height) / 2);
            left += image.width + gap;
        }
        Ok(strip)
    }

    /// Copies a picture that fits into this one at a position.
    fn paste(&mut self, image: &Self, left: u32, top: u32) {
        let bytes = 4 * image.width as usize;
        for y in 0..image.height {
            let to = 4 * ((top + y) as usize * self.width as usize + left as usize);
            let from = y as usize * bytes;
            self.rgba[to..to + bytes].copy_from_slice(&image.rgba[from..from + bytes]);
        }
    }

    /// The picture as a PNG file, marked as sRGB.
    ///
    /// # Errors
    /// `Io` for a picture that PNG cannot hold, such as an empty one.
    pub fn encode_png(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.write_png(&mut bytes)
            .map_err(|e| Error::io("encoding the picture as PNG", io::Error::other(e)))?;
        Ok(bytes)
    }

    fn write_png(&self, out: &mut Vec<u8>) -> std::result::Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgba)?;
        writer.finish()
    }
}

/// What tests look at; the command only encodes pictures.
#[cfg(test)]
impl Image {
    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Red, green, blue and opacity of every pixel, row by row from the top.
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(width: u32, height: u32) -> Image {
        let mut image = Image::blank(width, height, [0; 4]).unwrap();
        for (i, byte) in image.rgba.iter_mut().enumerate() {
            *byte = (i * i * 31 + i * 7) as u8;
        }
        image
    }

    #[test]
    fn a_png_decodes_to_the_same_pixels() {
        let image = noise(37, 11);
        let bytes = image.encode_png().unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (37, 11));
        assert_eq!(info.color_type, png::ColorType::Rgba);
        assert_eq!(pixels, image.rgba);
    }

    #[test]
    fn an_empty_picture_is_no_png() {
        let empty = Image::beside(&[], 3, [0; 4]).unwrap();
        assert_eq!((empty.width, empty.height), (0, 0));
        assert_eq!(empty.encode_png().unwrap_err().kind(), ErrorKind::Io);
    }

    #[test]
    fn a_strip_keeps_every_picture_and_fills_the_gaps() {
        let images = [noise(5, 4), noise(3, 8), noise(1, 1)];
        let strip = Image::beside(&images, 2, [9; 4]).unwrap();
        assert_eq!((strip.width(), strip.height()), (5 + 2 + 3 + 2 + 1, 8));
        let pixel = |image: &Image, x: u32, y: u32| {
            image.rgba()[4 * (y * image.width() + x) as usize..][..4].to_vec()
        };
        for (image, left, top) in [(&images[0], 0, 2), (&images[1], 7, 0), (&images[2], 12, 3)] {
            for (x, y) in (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)))
            {
                assert_eq!(pixel(&strip, left + x, top + y), pixel(image, x, y));
            }
        }
        for (x, y) in [(0, 1), (0, 6), (5, 4), (6, 0), (10, 7), (12, 4)] {
            assert_eq!(pixel(&strip, x, y), [9; 4]);
        }
    }

    #[test]
    fn a_strip_too_wide_is_refused() {
        let images = [noise(1, 1), noise(1, 1)];
        let err = Image::beside(&images, u32::MAX - 1, [0; 4]).unwrap_err();
        assert_eq!(err.kind(), ErrorKind::TooLarge);
    }
}
