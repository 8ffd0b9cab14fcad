#include "experiment/timing/refresh_ledger.h"

#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

constexpr SessionDuration interval = std::chrono::milliseconds(10);

PageCycle plan() { return make_page_cycle({61, 25.0, Degrees{25.0}, Playback::cycle, 2.0}, 100.0); }

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

TEST_CASE("dropping keeps the time of the plan, stretching keeps its frames", "[unit]") {
    const PageCycle cycle = plan();
    const auto three_before_refresh_21 = [](int refresh) { return refresh == 21 ? 3 : 0; };
    const Book dropped = play(cycle, WhenLate::drop, three_before_refresh_21);
    CHECK(dropped.flips.size() == static_cast<std::size_t>(cycle.total_refreshes) - 3);
    CHECK(dropped.flips.back().refresh_in_trial == cycle.total_refreshes - 1);
    for (const FlipRecord& flip : dropped.flips) {
        CHECK(flip.planned == cycle.entry_at(flip.refresh_in_trial).frame);
        if (flip.report.missed_refreshes == 0)
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
