#include "experiment/timing/refresh_ledger.h"

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/motion_of.h"

using namespace overt;

namespace {

constexpr SessionDuration interval = std::chrono::milliseconds(10);

PageCycle plan() { return make_page_cycle(motion_of(61, 25.0, 2.0), 100.0); }

struct Book {
    std::vector<FlipRecord> flips;
    std::vector<MissedRefresh> missed;
    int shown = 0, missed_in_all = 0;
};

/// Plays the plan on a display that lets `miss(refresh)` refreshes go by before the one aimed at.
template <class Miss> Book play(const PageCycle& cycle, WhenLate when_late, Miss miss) {
    RefreshLedger ledger(cycle, when_late);
    Book book;
    std::int64_t refresh = 5000;
    for (ledger.begin(3); !ledger.is_complete();) {
        FlipReport report;
        refresh += 1 + miss(static_cast<int>(refresh - 5000));
        report.refresh = {refresh};
        report.vertical_blank = SessionTime(refresh * interval);
        book.flips.push_back(ledger.enter(report));
        for (int i = 0; i < ledger.missed_count(); ++i)
            book.missed.push_back(ledger.missed(i));
    }
    book.shown = ledger.shown_refreshes();
    book.missed_in_all = ledger.missed_refreshes();
    return book;
}

/// How many rows each refresh of the plan has.
std::vector<int> rows_of(const Book& book, int planned) {
    std::vector<int> rows(static_cast<std::size_t>(planned));
    for (const FlipRecord& flip : book.flips)
        if (flip.refresh_in_trial < planned)
            ++rows[static_cast<std::size_t>(flip.refresh_in_trial)];
    for (const MissedRefresh& one : book.missed)
        ++rows.at(static_cast<std::size_t>(one.refresh_in_trial));
    return rows;
}

} // namespace

TEST_CASE("each refresh of the plan has one row, whatever went by", "[unit]") {
    const PageCycle cycle = plan();
    for (const WhenLate when_late : {WhenLate::drop, WhenLate::stretch}) {
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            RandomStream random(seed, "ledger test");
            const Book book = play(cycle, when_late, [&](int) {
                return random.below(20) == 0 ? static_cast<int>(random.below(30)) : 0;
            });
            REQUIRE(rows_of(book, cycle.total_refreshes) ==
                    std::vector<int>(static_cast<std::size_t>(cycle.total_refreshes), 1));
            REQUIRE(book.shown == static_cast<int>(book.flips.size()));
            REQUIRE(book.shown + book.missed_in_all == book.flips.back().refresh_in_trial + 1);
        }
    }
}

TEST_CASE("what was lit while refreshes were missed is what the flip before them had shown", "[unit]") {
    const PageCycle cycle = plan();
    for (const WhenLate when_late : {WhenLate::drop, WhenLate::stretch}) {
        // Long enough for several frames of the plan to go by, each time.
        const Book book = play(cycle, when_late, [](int refresh) { return refresh % 17 == 5 ? 11 : 0; });
        REQUIRE(book.missed.size() > 50);
        int changes = 0;
        for (const MissedRefresh& missed : book.missed) {
            const auto after = std::ranges::find_if(book.flips, [&](const FlipRecord& flip) {
                return flip.refresh_in_trial > missed.refresh_in_trial;
            });
            REQUIRE(after != book.flips.begin());
            const FlipRecord& before = *std::prev(after);
            REQUIRE(missed.shown == before.shown);
            REQUIRE(missed.pose == before.pose);
            changes += after->shown != before.shown;
        }
        // Where frames are dropped the next flip shows another one; stretched, the plan goes on where it was.
        CHECK((changes > 20) == (when_late == WhenLate::drop));
    }
}

TEST_CASE("dropping keeps the time of the plan, stretching keeps its frames", "[unit]") {
    const PageCycle cycle = plan();
    const auto three_before_refresh_21 = [](int refresh) { return refresh == 21 ? 3 : 0; };
    const Book dropped = play(cycle, WhenLate::drop, three_before_refresh_21);
    CHECK(dropped.flips.size() == static_cast<std::size_t>(cycle.total_refreshes) - 3);
    CHECK(dropped.flips.back().refresh_in_trial == cycle.total_refreshes - 1);
    for (const FlipRecord& flip : dropped.flips) {
        CHECK(flip.planned == cycle.entry_at(flip.refresh_in_trial).frame);
        if (flip.missed_refreshes == 0)
            CHECK(flip.shown == flip.planned);
    }
    const Book stretched = play(cycle, WhenLate::stretch, three_before_refresh_21);
    REQUIRE(stretched.flips.size() == static_cast<std::size_t>(cycle.total_refreshes));
    CHECK(stretched.flips.back().refresh_in_trial == cycle.total_refreshes + 2);
    CHECK(stretched.flips.back().planned == no_frame);
    for (std::size_t i = 0; i < stretched.flips.size(); ++i) {
        const FlipRecord& flip = stretched.flips[i];
        CHECK(flip.shown == cycle.entry_at(static_cast<int>(i)).frame);
        if (flip.refresh_in_trial < cycle.total_refreshes)
            CHECK(flip.planned == cycle.entry_at(flip.refresh_in_trial).frame);
    }
}

TEST_CASE("a missed refresh says what the plan had, what stayed, and when", "[unit]") {
    const PageCycle cycle = plan();
    const Book book = play(cycle, WhenLate::drop, [](int refresh) { return refresh == 21 ? 3 : 0; });
    REQUIRE(book.missed.size() == 3);
    const FlipRecord before = book.flips[20];
    for (int i = 0; i < 3; ++i) {
        const MissedRefresh& missed = book.missed[static_cast<std::size_t>(i)];
        CHECK(missed.trial == 3);
        CHECK(missed.refresh_in_trial == 20 + 1 + i);
        CHECK(missed.refresh.value == before.report.refresh.value + 1 + i);
        CHECK(missed.planned == cycle.entry_at(missed.refresh_in_trial).frame);
        CHECK(missed.shown == before.shown);
        CHECK(missed.pose == before.pose);
        CHECK(missed.vertical_blank == before.report.vertical_blank + (1 + i) * interval);
    }
}

TEST_CASE("a count that stands still or goes back does not hold up a presentation", "[unit]") {
    const PageCycle cycle = plan();
    RefreshLedger ledger(cycle, WhenLate::drop);
    ledger.begin(0);
    int flips = 0;
    for (; !ledger.is_complete() && flips < 10'000; ++flips)
        ledger.enter({RefreshIndex{1000 - flips % 7}, {}, {}, SessionTime(flips * interval)});
    CHECK(flips == cycle.total_refreshes);
}

TEST_CASE("a missed refresh is as uncertain as the less certain of the flips around it", "[unit]") {
    const PageCycle cycle = plan();
    for (const auto& [first, second] : {std::pair{30, 700}, {700, 30}}) {
        RefreshLedger ledger(cycle, WhenLate::drop);
        ledger.begin(0);
        FlipReport report;
        report.refresh = {10};
        report.vertical_blank = SessionTime(10 * interval);
        report.uncertainty = std::chrono::microseconds(first);
        ledger.enter(report);
        report.refresh = {13};
        report.vertical_blank = SessionTime(13 * interval);
        report.uncertainty = std::chrono::microseconds(second);
        ledger.enter(report);
        REQUIRE(ledger.missed_count() == 2);
        for (int i = 0; i < 2; ++i)
            CHECK(ledger.missed(i).uncertainty == std::chrono::microseconds(700));
    }
}

TEST_CASE("a ledger that begins again knows nothing of the presentation before", "[unit]") {
    const PageCycle cycle = plan();
    const auto flip_at = [](std::int64_t refresh) {
        FlipReport report;
        report.refresh = {refresh};
        report.vertical_blank = SessionTime(refresh * interval);
        return report;
    };
    RefreshLedger used(cycle, WhenLate::drop), fresh(cycle, WhenLate::drop);
    used.begin(0);
    used.enter(flip_at(100));
    used.enter(flip_at(104)); // three refreshes go by
    REQUIRE(used.missed_count() == 3);
    used.begin(1);
    fresh.begin(1);
    CHECK(used.missed_count() == 0);
    CHECK(used.missed_refreshes() == 0);
    CHECK(used.shown_refreshes() == 0);
    CHECK_FALSE(used.is_complete());
    for (const std::int64_t refresh : {500, 501, 503}) {
        const FlipRecord& one = used.enter(flip_at(refresh));
        const FlipRecord& other = fresh.enter(flip_at(refresh));
        CHECK(one.trial == 1);
        CHECK(one.refresh_in_trial == other.refresh_in_trial);
        CHECK(one.shown == other.shown);
        CHECK(one.planned == other.planned);
        CHECK(one.missed_refreshes == other.missed_refreshes);
        CHECK(used.missed_count() == fresh.missed_count());
    }
    CHECK(used.missed_refreshes() == 1);
    CHECK(used.onset() == SessionTime(500 * interval));
}

TEST_CASE("a further show of an attempt counts on from its first onset, with its own plan", "[unit]") {
    const PageCycle cycle = plan();
    RefreshLedger ledger(cycle, WhenLate::drop);
    const auto flip_at = [&](std::int64_t refresh) {
        FlipReport report;
        report.refresh = {refresh};
        report.vertical_blank = SessionTime(refresh * interval);
        return ledger.enter(report);
    };
    ledger.begin(3, 2);
    CHECK(flip_at(1000).refresh_in_trial == 0);
    const RefreshIndex first = ledger.first();
    ledger.begin(3, 4, first);
    const FlipRecord onset = flip_at(1100);
    CHECK(onset.refresh_in_trial == 100);
    CHECK(onset.step == 4);
    CHECK(onset.missed_refreshes == 0);
    CHECK(onset.planned == cycle.entry_at(0).frame);
    CHECK(ledger.missed_count() == 0);
    CHECK(ledger.next_refresh() == 1);
    const FlipRecord late = flip_at(1104); // three go by
    CHECK(late.refresh_in_trial == 104);
    CHECK(ledger.last_refresh() == 4);
    CHECK(late.planned == cycle.entry_at(4).frame);
    REQUIRE(ledger.missed_count() == 3);
    CHECK(ledger.missed(0).refresh_in_trial == 101);
    CHECK(ledger.missed(2).planned == cycle.entry_at(3).frame);
    CHECK(ledger.next_refresh() == 5);
    for (std::int64_t refresh = 1105; !ledger.is_complete(); ++refresh)
        flip_at(refresh);
    CHECK(ledger.shown_refreshes() == cycle.total_refreshes - 3);
}
