use super::*;

#[test]
fn a_factor_raises_every_limit() {
    let budgets =
        [1, 3].map(|factor| Budget::new(BudgetFactor::new(factor).unwrap(), Progress::SILENT));
    let [once, thrice] = budgets.each_ref();
    assert_eq!(
        (once.decompressed_left(), thrice.decompressed_left()),
        (64 << 20, 192 << 20)
    );
    assert_eq!((once.pairs_left(10), thrice.pairs_left(10)), (800, 2400));
    assert!(
        once.charge_stored((1 << 30) + 1).is_err() && thrice.charge_stored((1 << 30) + 1).is_ok()
    );
    assert!(
        once.charge_text((1 << 30) + 1, true).is_err()
            && thrice.charge_text((1 << 30) + 1, true).is_ok()
    );
    assert!(once.charge_faces(1, 1 << 23).is_err() && thrice.charge_faces(1, 1 << 23).is_ok());
    assert_eq!(BudgetFactor::new(0), None);
    let error = once.charge_faces(1, 1).unwrap_err().to_string();
    assert!(error.contains("--input-budget 2"), "{error}");
    let error = thrice.charge_stored(u64::MAX).unwrap_err().to_string();
    assert!(error.contains("--input-budget 6"), "{error}");
}

#[test]
fn what_is_read_raises_what_it_may_expand_to() {
    let budget = Budget::default();
    budget.enter_bytes(1 << 20);
    assert_eq!(budget.decompressed_left(), (256 + 64) << 20);
    budget.charge_decompressed(300 << 20);
    assert_eq!(budget.decompressed_left(), 20 << 20);
    assert!(budget.charge_stored(1280 << 20).is_ok());
    assert!(budget.charge_stored(1).is_err());
    assert!(
        budget.charge_text(u64::MAX, false).is_ok(),
        "for the first time"
    );
}

#[test]
fn pairs_are_those_of_all_polygons() {
    let budget = Budget::default();
    assert_eq!(budget.pairs_left(100), 80_000);
    budget.charge_pairs(20_000);
    assert_eq!(
        (budget.pairs_left(100), budget.pairs_left(10)),
        (80_000, 800)
    );
    budget.charge_pairs(1);
    assert_eq!((budget.pairs_left(100), budget.pairs_left(10)), (0, 0));
    budget.enter_bytes(1);
    assert_eq!(budget.pairs_left(100), 80_000);
}

#[test]
fn a_file_read_again_counts_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    std::fs::write(&path, [0; 1000]).unwrap();
    let budget = Budget::default();
    assert!(!budget.enter(&path));
    assert!(budget.enter(&folder.path().join(".").join("a")));
    let account = budget.account();
    assert_eq!((account.distinct, account.read), (1000, 2000));
    drop(account);
    assert!(!budget.enter(&folder.path().join("missing")));
}
