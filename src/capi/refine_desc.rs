//! `carvel_refine_input` and `carvel_refine_output`: what to refine, and where it goes.

use super::buffer::{Name, Target, input};
use super::channel::{ChannelInput, ChannelOutput, Lent};
use super::guard::Call;
use super::status::{CARVEL_STATUS_LENGTH_MISMATCH, Fault, Result};
use super::values::{ConstValues, Records, Values, carvel_indices, interpolation};
use super::versioned::versioned;
use super::{carvel_mesh, carvel_scheme};
use crate::base::Scalar;
use crate::hierarchy::Interpolation;
use crate::mesh::Mesh;
use crate::scheme::Scheme;
use std::sync::Arc;

/// The most attributes, and the most channels, that one call refines.
const MOST_LISTED: u64 = 256;

versioned! {
    pub struct RefineInput<T> as "carvel_refine_input" {
        pub struct_size: u32,
        pub levels: u32,
        pub mesh: *const carvel_mesh,
        pub scheme: *const carvel_scheme,
        pub positions: ConstValues<T>,
        pub attributes: *const ConstValues<T>,
        pub attribute_count: u64,
        pub interpolations: *const i32,
        pub channels: *const ChannelInput<T>,
        pub channel_count: u64,
    }
}

versioned! {
    pub struct RefineOutput<T> as "carvel_refine_output" {
        pub struct_size: u32,
        pub anchored: i32,
        pub face_sizes: carvel_indices,
        pub face_offsets: carvel_indices,
        pub face_vertices: carvel_indices,
        pub face_sources: carvel_indices,
        pub positions: Values<T>,
        pub attributes: *const Values<T>,
        pub attribute_count: u64,
        pub channels: *const ChannelOutput<T>,
        pub channel_count: u64,
    }
}

pub type carvel_refine_input_f32 = RefineInput<f32>;
pub type carvel_refine_input_f64 = RefineInput<f64>;
pub type carvel_refine_output_f32 = RefineOutput<f32>;
pub type carvel_refine_output_f64 = RefineOutput<f64>;

/// Records for positions, attributes and channels, in this order.
pub(super) type AllRecords<P> = Vec<Records<P>>;

/// The output's lists, with an entry for each of the input's.
pub(super) struct Lists<'a, T> {
    pub(super) attributes: &'a [Values<T>],
    pub(super) channels: &'a [ChannelOutput<T>],
}

fn check_most(count: u64, what: &str) -> Result<()> {
    if count <= MOST_LISTED {
        return Ok(());
    }
    Err(Fault::out_of_range(format!("{count} {what}: the limit is {MOST_LISTED}")))
}

fn check_listed(count: u64, expected: u64, what: &str) -> Result<()> {
    if count == expected {
        return Ok(());
    }
    Err(Fault::new(
        CARVEL_STATUS_LENGTH_MISMATCH,
        format!("{count} output.{what} for {expected} of the input"),
    ))
}

impl<T: Scalar> RefineInput<T> {
    /// Checks positions and attributes.
    ///
    /// # Safety
    /// `attributes` leads to as many entries as the count says.
    pub(super) unsafe fn check(&self, mesh: &Mesh) -> Result<AllRecords<*const T>> {
        check_most(self.attribute_count, "attributes")?;
        // SAFETY: the caller's contract.
        let attributes =
            unsafe { input(self.attributes, self.attribute_count, "input.attributes")? };
        let vertices = mesh.vertices() as u64;
        let mut records = vec![self.positions.check_positions(vertices, "input.positions".into())?];
        for (i, attribute) in attributes.iter().enumerate() {
            let name = Name { text: "input.attributes", index: Some(i) };
            records.push(attribute.check(vertices, name)?);
        }
        Ok(records)
    }

    /// How each attribute is refined; all by the scheme's rows, if nothing is said.
    ///
    /// # Safety
    /// `interpolations` is NULL or leads to one for each attribute, of which there are
    /// as many as [`Self::check`] allows.
    pub(super) unsafe fn interpolations(&self, scheme: &Scheme) -> Result<Vec<Interpolation>> {
        let count = self.attribute_count;
        if self.interpolations.is_null() {
            return Ok(vec![Interpolation::Vertex; count as usize]);
        }
        // SAFETY: the caller's contract.
        let kinds = unsafe { input(self.interpolations, count, "input.interpolations")? };
        let check = |&kind: &i32| {
            let kind = interpolation(kind)?;
            scheme.check_interpolation(kind)?;
            Ok(kind)
        };
        kinds.iter().map(check).collect()
    }

    /// Checks the channels; adds their values to the records.
    ///
    /// # Safety
    /// The header's contract.
    pub(super) unsafe fn channels<'a>(
        &self,
        call: &mut Call<'a>,
        (mesh, scheme): (&Arc<Mesh>, &Scheme),
        records: &mut AllRecords<*const T>,
    ) -> Result<Vec<Lent<'a>>> {
        check_most(self.channel_count, "channels")?;
        // SAFETY: the caller's contract.
        let list = unsafe { input(self.channels, self.channel_count, "input.channels")? };
        let mut channels = Vec::with_capacity(list.len());
        for (i, channel) in list.iter().enumerate() {
            let name = Name { text: "input.channels", index: Some(i) };
            // SAFETY: the caller's contract.
            let (lent, values) = unsafe { channel.check(call, (mesh, scheme, self.levels), name)? };
            channels.push(lent);
            records.push(values);
        }
        Ok(channels)
    }
}

impl<T: Scalar> RefineOutput<T> {
    /// The attributes and channels, one for each of the input.
    ///
    /// # Safety
    /// The pointers lead to as many entries as the counts say.
    pub(super) unsafe fn lists<'a>(&self, of: &RefineInput<T>) -> Result<Lists<'a, T>> {
        check_listed(self.attribute_count, of.attribute_count, "attributes")?;
        check_listed(self.channel_count, of.channel_count, "channels")?;
        // SAFETY: the caller's contract.
        unsafe {
            let attributes = input(self.attributes, self.attribute_count, "output.attributes")?;
            let channels = input(self.channels, self.channel_count, "output.channels")?;
            Ok(Lists { attributes, channels })
        }
    }

    /// Bytes of the copies of records that are not one after the other.
    pub(super) fn copies(&self, lists: &Lists<T>, vertices: u64, channels: &[Lent]) -> u64 {
        let all = std::iter::once(&self.positions).chain(lists.attributes);
        let own = all.map(|values| values.copy_bytes(vertices));
        let channels = lists.channels.iter().zip(channels);
        let others = channels.map(|(out, lent)| out.values.copy_bytes(lent.plan.last().vertices));
        own.chain(others).fold(0, u64::saturating_add)
    }

    /// Checks all outputs of values.
    pub(super) fn check(
        &self,
        lists: &Lists<T>,
        vertices: u64,
        (inputs, channels): (&AllRecords<*const T>, &[Lent]),
    ) -> Result<AllRecords<*mut T>> {
        let mut records = vec![self.positions.check(vertices, 3, "output.positions".into())?];
        let (attributes, others) = inputs[1..].split_at(lists.attributes.len());
        for (i, (attribute, from)) in lists.attributes.iter().zip(attributes).enumerate() {
            let name = Name { text: "output.attributes", index: Some(i) };
            records.push(attribute.check(vertices, from.width, name)?);
        }
        for (i, ((out, lent), from)) in lists.channels.iter().zip(channels).zip(others).enumerate()
        {
            let name = Name { text: "output.channels", index: Some(i) };
            records.push(out.check(&lent.plan, from.width, name)?);
        }
        Ok(records)
    }
}

/// The room for the indices of all channels.
pub(super) fn targets<T: Scalar>(lists: &Lists<T>, channels: &[Lent]) -> Vec<Target<u32>> {
    let target = |(i, (out, lent)): (usize, (&ChannelOutput<T>, &Lent))| {
        out.target(&lent.plan, Name { text: "output.channels", index: Some(i) })
    };
    lists.channels.iter().zip(channels).enumerate().map(target).collect()
}

/// Scratch memory of all channels.
pub(super) fn channel_bytes<T: Scalar>(channels: &[Lent], values: &[Records<*const T>]) -> u64 {
    let bytes = |(lent, records): (&Lent, &Records<*const T>)| {
        crate::hierarchy::channel_bytes(lent.channel, &lent.plan, records.width as u64, T::BYTES)
    };
    channels.iter().zip(values).map(bytes).fold(0, u64::saturating_add)
}

/// Bytes of the copies of records that are not one after the other.
pub(super) fn input_copies<T: Scalar>(records: &AllRecords<*const T>) -> u64 {
    records.iter().map(Records::copy_bytes::<T>).fold(0, u64::saturating_add)
}
