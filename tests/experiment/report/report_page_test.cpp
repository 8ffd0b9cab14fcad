#include <catch2/catch.hpp>

#include <cstdlib>

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/report/report_page.h"
#include "experiment/report/surface_files.h"
#include "tests/experiment/report/made_up_study.h"
#include "tests/support/skip.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

// What stands between two texts.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    if (from == std::string::npos)
        return {};
    return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

} // namespace

TEST_CASE("the report's data come back from the page, whatever a session's texts hold", "[unit]") {
    const StudyResults study = test::made_up_study();
    const std::string page = report_page(study);
    const nlohmann::ordered_json data =
        parse_json(between(page, "<script type=\"application/json\" id=\"data\">", "</script>"));
    REQUIRE(!data.is_discarded());
    CHECK(data["glance"]["title"] == study.glance.title);
    CHECK(data["remarks"][1] == study.remarks[1]);
    CHECK(data["maps"].size() == study.maps.size());
    CHECK(data["maps"].back()["absent"] == "No fixation was counted.");
    CHECK(data["tables"]["heads"][0]["duration"]["v"].is_null());
    CHECK(data["trials"][3]["excluded"] == "More than half of its samples were lost.");
    CHECK(page.find("<title>A &lt;/script>") != page.npos);
    CHECK(page.find("<script src") == page.npos);
    CHECK(page.find("<link rel=\"stylesheet") == page.npos);
    CHECK(between(page, "<script>", "</script>").find("REVISION=\"111\"") != std::string::npos);
}

TEST_CASE("coloured meshes are written of all maps that there are, with an index", "[unit]") {
    const test::TemporaryFolder folder;
    const StudyResults study = test::made_up_study();
    // Eight maps by duration, one difference, and of two sculptures the exposure and the time visible; the
    // last map, which is by count, is absent.
    CHECK(write_surfaces(study, folder.path() / "surfaces") == 13);
    CHECK(std::filesystem::exists(folder.path() / "surfaces/exposure_ball.glb"));
    CHECK(std::filesystem::exists(folder.path() / "surfaces/visible_globe.ply"));
    CHECK(std::filesystem::exists(folder.path() /
                                  "surfaces/map_ball_task_free__sculpture_ball__material_smooth.glb"));
    const std::string index = read_whole_file(folder.path() / "surfaces/index.csv");
    CHECK(std::count(index.begin(), index.end(), '\n') == 1 + 2 * 13);
}

TEST_CASE("the report opens in a browser without errors, and each control changes what is shown", "[gl]") {
    if (std::system("command -v chromium >/dev/null 2>&1") != 0)
        OVERT_SKIP("no chromium here to open the report");
    const test::TemporaryFolder folder;
    std::string page = report_page(test::made_up_study());
    const std::string script = read_whole_file(OVERT_SOURCE_DIR "/tests/data/report/exercise.js");
    page.insert(page.find("<body>") + 6, fmt::format("<script>{}</script>", script));
    const std::filesystem::path file = folder.file("report.html", page);
    const std::string command =
        fmt::format("chromium --headless --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader "
                    "--enable-unsafe-swiftshader --user-data-dir={0}/profile --window-size=1280,1600 "
                    "--virtual-time-budget=20000 --dump-dom file://{1} >{0}/page.html 2>{0}/chromium.log",
                    folder.path().string(), file.string());
    REQUIRE(std::system(command.c_str()) == 0);
    const nlohmann::ordered_json seen =
        parse_json(between(read_whole_file(folder.path() / "page.html"),
                           "<script type=\"application/json\" id=\"seen\">", "</script>"));
    INFO(read_whole_file(folder.path() / "chromium.log"));
    REQUIRE(!seen.is_discarded());
    CHECK(seen["errors"].dump() == "[]");
    CHECK(seen["blank"].dump() == "[]");
    CHECK(seen["bad_texts"].dump() == "[]");
    CHECK(seen["svg_nan"] == 0);
    CHECK(seen["steps"].size() >= 32);
    for (const auto& step : seen["steps"]) {
        INFO(step["name"].get<std::string>());
        CHECK(step["changed"] == true);
    }
}
