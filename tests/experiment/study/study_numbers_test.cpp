/// All tables of a study whose cells are unequal, column by column, as they were when what they say was
/// tried: a number that changes is to be meant. OVERT_WRITE_REFERENCE=1 writes tests/experiment/study/numbers
/// anew.
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/base/text_number.h"
#include "experiment/base/whole_file.h"
#include "experiment/study/analyze_study.h"
#include "experiment/study/tables/study_tables.h"
#include "tests/experiment/study/varied_study.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, '\t');)
        cells.push_back(cell);
    return cells;
}

/// Numbers of a column: how many, and their sum, each row in its own proportion; of words a hash.
struct ColumnSum {
    int numbers = 0, words = 0;
    double sum = 0.0;
    std::string text = {};
};

using TableSums = std::map<std::string, ColumnSum>; ///< by "table.column"

void add_table(TableSums& sums, const std::string& table, const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> columns = cells_of(line);
    for (int row = 0; std::getline(lines, line); ++row) {
        const std::vector<std::string> cells = cells_of(line);
        for (std::size_t i = 0; i < std::min(columns.size(), cells.size()); ++i) {
            ColumnSum& column = sums[table + "." + columns[i]];
            if (const auto number = number_in<double>(cells[i])) {
                ++column.numbers;
                column.sum += (1.0 + row % 13) * *number;
            } else {
                ++column.words;
                column.text += cells[i] + "\n";
            }
        }
    }
}

/// A line for each column, and one for each remark.
std::string lines_of(const StudyResults& results) {
    const test::TemporaryFolder folder;
    write_study_tables(results, folder.path(), TableFormat::tsv);
    TableSums sums;
    for (const auto& file : std::filesystem::directory_iterator(folder.path()))
        if (file.path().extension() == ".tsv" && file.path().stem() != "reporting")
            add_table(sums, file.path().stem().string(), read_whole_file(file.path()));
    std::string all;
    for (const auto& [name, column] : sums)
        all += fmt::format("{}\t{}\t{:.9g}\t{}\t{}\n", name, column.numbers, column.sum, column.words,
                           column.text.empty() ? "-" : hash_of_text(column.text).substr(0, 8));
    const auto add_surface_sum = [&](const std::string& name, const auto& values) {
        double sum = 0.0;
        for (std::size_t v = 0; v < values.size(); ++v)
            sum += (1.0 + static_cast<double>(v % 13)) * static_cast<double>(values[v]);
        all += fmt::format("{}\t{}\t{:.6g}\n", name, values.size(), sum);
    };
    for (const StudyObject& object : results.objects)
        add_surface_sum("exposure on " + object.id, object.exposure_density);
    for (const StudyMap& map : results.maps)
        add_surface_sum(fmt::format("map of group {}", map.group), map.density);
    for (const std::vector<DifferenceMap>* maps : {&results.differences, &results.answer_maps})
        for (const DifferenceMap& map : *maps) {
            add_surface_sum(fmt::format("difference of {} and {}", map.a, map.b), map.difference);
            add_surface_sum("its clusters", map.cluster);
        }
    for (const std::string& remark : results.remarks)
        all += "remark\t" + remark + "\n";
    return all;
}

/// The lines that differ, with what they were; numbers may in the seventh digit.
std::string differing(const std::string& now, const std::string& before) {
    std::istringstream one(now), other(before);
    std::string found, a, b;
    while (true) {
        const bool has_one = static_cast<bool>(std::getline(one, a)),
                   has_other = static_cast<bool>(std::getline(other, b));
        if (!has_one && !has_other)
            return found;
        const std::vector<std::string> is = has_one ? cells_of(a) : std::vector<std::string>{},
                                       was = has_other ? cells_of(b) : std::vector<std::string>{};
        bool is_same = is.size() == was.size();
        for (std::size_t i = 0; i < is.size() && is_same; ++i) {
            const auto x = number_in<double>(is[i]), y = number_in<double>(was[i]);
            is_same = is[i] == was[i] || (i == 2 && x && y && *x == Approx(*y).epsilon(2e-6).margin(1e-6));
        }
        if (!is_same)
            found += fmt::format("is  {}\nwas {}\n", has_one ? a : "", has_other ? b : "");
    }
}

void check_numbers(const std::string& name, ReadStudy study, StudyOptions options) {
    options.resamples = 60;
    options.permutations = 40;
    const std::string now =
        lines_of(analyze_study(std::move(study), options, [](std::string_view, int, int) {}));
    const auto file =
        std::filesystem::path(OVERT_SOURCE_DIR) / "tests/experiment/study/numbers" / (name + ".tsv");
    if (std::getenv("OVERT_WRITE_REFERENCE"))
        std::ofstream(file) << now;
    CHECK(differing(now, read_whole_file(file)) == "");
}

} // namespace

TEST_CASE("a study of unequal cells has the numbers that it had", "[unit]") {
    check_numbers("by_cells", test::varied_study(), {});
}

TEST_CASE("a study of tasks, without a threshold and in space, has the numbers that it had", "[unit]") {
    StudyOptions options;
    options.by = {"task", "material"};
    options.compare = "task";
    options.areas = {"nose", "head"};
    options.kernel = MapKernel::euclidean;
    options.threshold_free = true;
    options.confidence = 0.9;
    options.smallest_effect = 0.3;
    options.time_step_s = 0.5;
    options.seed = 5;
    check_numbers("by_task", test::varied_study({.observers = 6}), options);
}

TEST_CASE("a study of one observer has the numbers that it had", "[unit]") {
    check_numbers("of_one", test::varied_study({.observers = 1}), {});
}

TEST_CASE("a study of small objects, short trials and models has the numbers that it had", "[unit]") {
    const test::TemporaryFolder folder;
    ReadStudy study = test::varied_study({.observers = 4, .size = 0.01, .time = 0.2, .is_seen = false});
    const Mesh& egg = *study.results.objects[0].mesh;
    const std::filesystem::path model = folder.path() / "model.ply";
    {
        std::ofstream out(model);
        out << "ply\nformat ascii 1.0\nelement vertex " << egg.positions.size()
            << "\nproperty float x\nproperty float y\nproperty float z\nproperty float density\nelement face "
            << egg.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const glm::vec3& at : egg.positions)
            out << at.x << ' ' << at.y << ' ' << at.z << ' ' << 1.0f + std::max(0.0f, at.z) << '\n';
        for (const glm::uvec3& t : egg.triangles)
            out << "3 " << t.x << ' ' << t.y << ' ' << t.z << '\n';
    }
    StudyOptions options;
    options.by = {"material", "object"};
    options.kernel = MapKernel::voxel;
    options.time_step_s = 0.1;
    options.models = {{"egg", model}};
    check_numbers("of_small", std::move(study), options);
}
