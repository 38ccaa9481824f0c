//! Files: what comes back is what went, and nothing else is taken for a table.

use carvel::base::Scalar;
use carvel::{ErrorKind, StencilTable, StoredTable};
use proptest::prelude::*;

use crate::tables::rows;

fn small() -> StencilTable<f32> {
    StencilTable::new(3, &[0, 2, 2, 3], vec![0, 1, 2], vec![0.5, 0.25, -1.0]).expect("a table")
}

fn bytes(table: &StencilTable<f32>) -> Vec<u8> {
    let mut file = Vec::new();
    table.write(&mut file).expect("memory takes everything");
    file
}

fn kind(file: &[u8]) -> Result<StoredTable, ErrorKind> {
    StoredTable::read(file).map_err(|error| error.kind())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn what_is_written_is_read(rows in rows()) {
        let (single, double) = (rows.table::<f32>(), rows.table::<f64>());
        let mut file = Vec::new();
        double.write(&mut file).expect("memory takes everything");
        prop_assert_eq!(StoredTable::read(&file[..]).expect("a table"), StoredTable::F64(double));
        prop_assert_eq!(kind(&bytes(&single)), Ok(StoredTable::F32(single)));
    }
}

/// The format as documented, byte by byte: a file of today is read for ever.
#[test]
fn the_format_stays() {
    let table = StencilTable::new(2, &[0, 1], vec![1], vec![1.0_f32]).expect("a table");
    let mut expected = b"CARVELST".to_vec();
    expected.extend([1, 0, 0, 0, 4, 0, 0, 0]);
    for count in [1_u64, 2, 1] {
        expected.extend(count.to_le_bytes());
    }
    expected.extend([0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0x80, 0x3f]);
    let file = bytes(&table);
    assert_eq!(file[..file.len() - 4], expected);
    assert_eq!(file.len(), expected.len() + 4);
    assert_eq!(file[file.len() - 4..], crc(&expected).to_le_bytes());
}

/// CRC-32 (IEEE), bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 * (sum & 1)))
    })
}

#[test]
fn every_changed_byte_and_every_cut_is_an_error() {
    let file = bytes(&small());
    for at in 0..file.len() {
        for flip in [1, 0x80, 0xff] {
            let mut changed = file.clone();
            changed[at] ^= flip;
            let kind = kind(&changed).expect_err("a changed file");
            let version = (8..12).contains(&at);
            assert_eq!(
                kind,
                if version { ErrorKind::Unsupported } else { ErrorKind::Syntax },
                "byte {at}"
            );
        }
        assert_eq!(kind(&file[..at]), Err(ErrorKind::Syntax), "cut at {at}");
    }
    let longer: Vec<u8> = file.iter().copied().chain([0]).collect();
    assert_eq!(kind(&longer), Err(ErrorKind::Syntax));
}

/// A file whose checksum fits and whose content is no table, or promises too much.
#[test]
fn signed_nonsense_is_an_error() {
    let signed = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut file = bytes(&small());
        file.truncate(file.len() - 4);
        change(&mut file);
        let sum = crc(&file);
        file.extend(sum.to_le_bytes());
        kind(&file)
    };
    assert!(signed(&|_| ()).is_ok());
    let put = |at: usize, bytes: &[u8]| {
        let bytes = bytes.to_vec();
        signed(&move |file: &mut Vec<u8>| file[at..at + bytes.len()].copy_from_slice(&bytes))
    };
    let syntax = Err(ErrorKind::Syntax);
    // Rows, columns and entries beyond all memory cost nothing.
    for at in [16, 24, 32] {
        for huge in [u64::MAX, 1 << 32, u64::from(u32::MAX), u64::from(u32::MAX) - 1] {
            let found = put(at, &huge.to_le_bytes());
            let fits = at == 24 && huge < u64::from(u32::MAX);
            assert!(if fits { found.is_ok() } else { found == syntax }, "{at} {huge}");
        }
    }
    assert_eq!(put(12, &[5, 0, 0, 0]), syntax, "bytes of a weight");
    assert_eq!(put(12, &[8, 0, 0, 0]), syntax, "weights of another type");
    assert_eq!(put(40, &[1, 0, 0, 0]), syntax, "the first row begins later");
    assert_eq!(put(44, &[9, 0, 0, 0]), syntax, "offsets that do not ascend");
    assert_eq!(put(52, &[2, 0, 0, 0]), syntax, "the last row ends early");
    assert_eq!(put(56, &[3, 0, 0, 0]), syntax, "a column that does not exist");
    assert_eq!(put(68, &f32::NAN.to_le_bytes()), syntax, "a weight that is no number");
}

/// A stream that fails is an error of its own.
#[test]
fn streams_that_fail() {
    struct Broken;
    impl std::io::Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("broken"))
        }
    }
    impl std::io::Write for Broken {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("broken"))
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    assert_eq!(StoredTable::read(Broken).unwrap_err().kind(), ErrorKind::Io);
    assert_eq!(small().write(Broken).unwrap_err().kind(), ErrorKind::Io);
}

/// More than a block of numbers, so that blocks meet where they should.
#[test]
fn large_tables_come_back() {
    let n = 70_001_u32;
    let offsets: Vec<u64> = (0..=u64::from(n)).collect();
    let weights = (0..n).map(|i| f64::from_f64(f64::from(i) / 3.0)).collect();
    let table = StencilTable::new(n as usize, &offsets, (0..n).rev().collect(), weights);
    let table = table.expect("a table");
    let mut file = Vec::new();
    table.write(&mut file).expect("memory takes everything");
    assert_eq!(StoredTable::read(&file[..]).expect("a table"), StoredTable::F64(table));
}
