#include "experiment/record/seal_chain.h"

#include <set>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

TableSeal example_line() {
    return {"sample", "trial_id, n, x_px", SealedRows::of_trial, 0, 0, 3, hash_of_text("rows"), "locator"};
}

} // namespace

TEST_CASE("a seal depends on the seal before it and on all that it says", "[unit]") {
    const ContentHash before = hash_of_text("the seal before");
    const TableSeal line = example_line();
    std::set<std::string> seen{seal_hash(before, SealKind::trial, 1, 7, {line})};
    const auto is_new = [&](const ContentHash& hash) { return seen.insert(hash).second; };
    CHECK_FALSE(is_new(seal_hash(before, SealKind::trial, 1, 7, {line})));
    CHECK(is_new(seal_hash(hash_of_text("another"), SealKind::trial, 1, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::other, 1, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 2, 7, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 8, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, std::nullopt, {line})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 7, {})));
    CHECK(is_new(seal_hash(before, SealKind::trial, 1, 7, {line, line})));
    const auto with = [&](auto change) {
        TableSeal other = example_line();
        change(other);
        return seal_hash(before, SealKind::trial, 1, 7, {other});
    };
    CHECK(is_new(with([](TableSeal& s) { s.name = "flip"; })));
    CHECK(is_new(with([](TableSeal& s) { s.columns = "trial_id, n"; })));
    CHECK(is_new(with([](TableSeal& s) { s.rows = SealedRows::all; })));
    CHECK(is_new(with([](TableSeal& s) { s.after_id = 1; })));
    CHECK(is_new(with([](TableSeal& s) { s.to_id = 1; })));
    CHECK(is_new(with([](TableSeal& s) { s.row_count = 4; })));
    CHECK(is_new(with([](TableSeal& s) { s.sha256 = hash_of_text("other rows"); })));
    CHECK(is_new(with([](TableSeal& s) { s.locator = "elsewhere"; })));
}
