/// A study that is simulated, interrupted, gone on with and analysed beside its truth.
#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

ProgramRun replicate(const SmallExperiment& experiment, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"replicate", experiment.protocol().string(),
                                       "--context", "osmesa",
                                       "--out",     (experiment.folder().path() / "study").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment.overt(arguments);
}

/// The cells of a column, by the rows whose other columns are all "all" but for `column`.
std::string cell(const std::string& table, const std::string& column, const std::string& level,
                 const std::string& wanted) {
    std::istringstream lines(table);
    std::string line;
    const auto cells_of = [](const std::string& text) {
        std::vector<std::string> cells{""};
        for (const char c : text) {
            if (c == ',')
                cells.emplace_back();
            else if (c != '\r')
                cells.back() += c;
        }
        return cells;
    };
    std::getline(lines, line);
    const std::vector<std::string> names = cells_of(line);
    const auto at = [&](const std::vector<std::string>& cells, const std::string& name) {
        return cells.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
    };
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = cells_of(line);
        bool is_it = at(cells, column) == level;
        for (const char* const other : {"task", "object", "material"})
            is_it = is_it && (other == column || at(cells, other) == "all");
        if (is_it)
            return at(cells, wanted);
    }
    return "no row";
}

} // namespace

TEST_CASE("a simulated study has the truth that was planted beside what is found, and goes on where it ended",
          "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path study = experiment.folder().path() / "study";
    const ProgramRun first = replicate(experiment, {"--observers", "2"});
    INFO(first.err);
    REQUIRE(first.exit_code == 0);
    CHECK_THAT(first.out, Catch::Contains("2 simulated observers"));
    const std::string figures = text_of(study / "analysis/figure4_area_share.csv");
    CAPTURE(figures);
    // What small_protocol plants.
    for (const auto& [task, share] : {std::pair{"face", 1.0}, {"clothes", 0.0}, {"free", 0.5}}) {
        CAPTURE(task);
        CHECK(std::stod(cell(figures, "task", task, "planted")) == Approx(share));
        CHECK(std::abs(std::stod(cell(figures, "task", task, "by_count")) - share) < 0.35);
        // Nothing is left to chance where all fixations are on heads, or none.
        const double drawn = std::stod(cell(figures, "task", task, "drawn"));
        CHECK((share == 0.5 ? drawn > 0.1 && drawn < 0.9 : drawn == share));
    }
    // Sessions that are there are not run again, and an analysis is not written over.
    const std::vector<std::filesystem::path> said{study / "sessions/observer_01.txt",
                                                  study / "sessions/observer_03.txt"};
    const auto size_before = std::filesystem::file_size(said[0]);
    CHECK(replicate(experiment, {"--observers", "3"}).exit_code == 2);
    const ProgramRun more = replicate(experiment, {"--observers", "3", "--overwrite"});
    INFO(more.err);
    CHECK(more.exit_code == 0);
    CHECK_THAT(more.out, Catch::Contains("3 simulated observers"));
    CHECK(std::filesystem::file_size(said[0]) == size_before);
    CHECK(std::filesystem::exists(said[1]));
    // Another protocol's sessions are not taken for this one's.
    std::ofstream(experiment.protocol(), std::ios::app) << "\n# changed\n";
    const ProgramRun changed = replicate(experiment, {"--observers", "3", "--overwrite"});
    CHECK(changed.exit_code == 2);
    CHECK_THAT(changed.err, Catch::Contains("another protocol") && Catch::Contains("--out"));
}
