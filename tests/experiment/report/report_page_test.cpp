#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/report/report_page.h"
#include "experiment/report/surface_files.h"
#include "tests/experiment/report/made_up_study.h"
#include "tests/support/map_files.h"
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
    CHECK(data["tables"]["surface_areas"][0]["duration"]["v"].is_null());
    CHECK(data["trials"][3]["excluded"] == "More than half of its samples were lost.");
    CHECK(page.find("<title>A &lt;/script>") != page.npos);
    CHECK(page.find("<script src") == page.npos);
    CHECK(page.find("<link rel=\"stylesheet") == page.npos);
    CHECK(between(page, "<script>", "</script>").find("REVISION=\"111\"") != std::string::npos);
}

TEST_CASE("coloured meshes are written of all maps that there are, with an index", "[unit]") {
    const test::TemporaryFolder folder;
    const StudyResults study = test::made_up_study();
    // Eight maps by duration, one difference, and of two objects the exposure and the time visible; the
    // last map, which is by count, is absent.
    CHECK(write_surfaces(study, folder.path() / "surfaces") == 13);
    CHECK(std::filesystem::exists(folder.path() / "surfaces/exposure_ball.glb"));
    CHECK(std::filesystem::exists(folder.path() / "surfaces/visible_globe.ply"));
    CHECK(std::filesystem::exists(folder.path() /
                                  "surfaces/map_ball_task_free__object_ball__material_smooth.glb"));
    const std::string index = read_whole_file(folder.path() / "surfaces/index.csv");
    CHECK(std::count(index.begin(), index.end(), '\n') == 1 + 2 * 13);
}

TEST_CASE("a map over its exported mesh is the same in either format, each in its own units", "[unit]") {
    const test::TemporaryFolder folder;
    StudyResults study = test::made_up_study();
    // A mesh in centimetres, far from the origin of its file.
    study.objects[0].mm_per_unit = 10.0;
    study.objects[0].origin = {100.0, -20.0, 3.0};
    write_surfaces(study, folder.path());
    const std::string name = "map_ball_task_free__object_ball__material_smooth";
    const test::ReadMap ply = test::read_coloured_ply((folder.path() / (name + ".ply")).string()),
                        glb = test::read_glb((folder.path() / (name + ".glb")).string());
    // A ball of 50 cm: millimetres with +z up, and metres with +y up.
    CHECK(ply.high().z - ply.low().z == Approx(1000.0).epsilon(1e-4));
    CHECK(glb.high().y - glb.low().y == Approx(1.0).epsilon(1e-4));
    REQUIRE(ply.integral() > 0.0);
    CHECK(glb.integral() == Approx(ply.integral()).epsilon(1e-4));
    CHECK(ply.legend.find("lengths: mm of the object") != std::string::npos);
    CHECK(ply.legend.find("origin: 1000 -200 30 mm") != std::string::npos);
    CHECK(glb.legend.find("0.03 m, with z up") != std::string::npos);
}

namespace {

bool has_program(const std::string& name) {
    return std::system(fmt::format("command -v {} >/dev/null 2>&1", name).c_str()) == 0;
}

/// Runs the browser in a folder, without a network.
void run_chromium(const std::filesystem::path& folder, const std::string& arguments) {
    REQUIRE(
        std::system(fmt::format("cd {0} && chromium --headless --no-sandbox --disable-gpu --use-gl=angle "
                                "--use-angle=swiftshader --enable-unsafe-swiftshader "
                                "--user-data-dir={0}/profile --virtual-time-budget=20000 {1} 2>>chromium.log",
                                folder.string(), arguments)
                        .c_str()) == 0);
}

std::string page_with(const StudyResults& study, const std::string& head) {
    std::string page = report_page(study);
    page.insert(page.find("<body>") + 6, head);
    return page;
}

/// What the exercise of the page's controls saw in a window, or in a frame, so many pixels wide.
nlohmann::ordered_json seen_of(const StudyResults& study, int width_px, const std::string& options = {}) {
    const test::TemporaryFolder folder;
    const std::string script = read_whole_file(OVERT_SOURCE_DIR "/tests/data/report/exercise.js");
    folder.file("report.html", page_with(study, fmt::format("<script>{}</script>", script)));
    // A browser's window has a least width, a frame has none.
    folder.file("frame.html",
                fmt::format("<iframe src=report.html width={} height=1200></iframe><script>addEventListener("
                            "'message', e => {{ const s = document.createElement('script'); s.type = s.id = "
                            "'seen'; s.textContent = e.data; document.body.append(s); }});</script>",
                            width_px));
    run_chromium(folder.path(), fmt::format("{} --window-size={},1600 --dump-dom file://{}/frame.html "
                                            ">page.html",
                                            options, width_px + 60, folder.path().string()));
    UNSCOPED_INFO(read_whole_file(folder.path() / "chromium.log"));
    const nlohmann::ordered_json seen = parse_json(between(
        read_whole_file(folder.path() / "page.html"), "<script id=\"seen\" type=\"seen\">", "</script>"));
    REQUIRE(!seen.is_discarded());
    return seen;
}

/// A picture as pdftoppm writes it.
struct Pixels {
    int width = 0, height = 0;
    std::string rgb;
};

Pixels read_ppm(const std::filesystem::path& file) {
    const std::string text = read_whole_file(file);
    Pixels pixels;
    int most = 0, begin = 0;
    REQUIRE(std::sscanf(text.c_str(), "P6 %d %d %d%n", &pixels.width, &pixels.height, &most, &begin) == 3);
    pixels.rgb = text.substr(static_cast<std::size_t>(begin) + 1);
    return pixels;
}

} // namespace

TEST_CASE("the report opens in a browser without errors, and each control changes what is shown", "[gl]") {
    if (!has_program("chromium"))
        OVERT_SKIP("no chromium here to open the report");
    const nlohmann::ordered_json seen = seen_of(test::made_up_study(), 1280);
    CHECK(seen["errors"].dump() == "[]");
    CHECK(seen["blank"].dump() == "[]");
    CHECK(seen["bad_texts"].dump() == "[]");
    CHECK(seen["svg_nan"] == 0);
    CHECK(seen["steps"].size() >= 33);
    for (const auto& step : seen["steps"]) {
        INFO(step["name"].get<std::string>());
        CHECK(step["changed"] == true);
    }
    // Each trial has a trace, and the page says so.
    CHECK(seen["traces"]["trials"] == 4);
    CHECK(seen["traces"]["without"] == 0);
    CHECK(seen["traces"]["said"].get<std::string>().starts_with("Each of the 4 trials"));
}

TEST_CASE("the page begins with what its main result is of", "[gl]") {
    if (!has_program("chromium"))
        OVERT_SKIP("no chromium here to open the report");
    StudyResults study = test::made_up_study();
    const auto order_of = [&](const std::string& measure) {
        study.headline.measure = measure;
        const nlohmann::ordered_json seen = seen_of(study, 1280);
        CHECK(seen["links"] == seen["sections"]);
        return seen;
    };
    const auto place = [](const nlohmann::ordered_json& names, const std::string& name) {
        const auto known = names.get<std::vector<std::string>>();
        REQUIRE(std::ranges::count(known, name) == 1);
        return std::ranges::find(known, name) - known.begin();
    };
    nlohmann::ordered_json seen = order_of("times");
    CHECK(seen["parts"][0] == "Response times");
    CHECK(place(seen["sections"], "answers") == 1);
    seen = order_of("areas");
    CHECK(place(seen["sections"], "figure4") == 1);
    CHECK(place(seen["sections"], "figure4") < place(seen["sections"], "maps"));
    CHECK(place(seen["sections"], "light") < place(seen["sections"], "answers"));
    CHECK(place(seen["sections"], "answers") < place(seen["sections"], "trials"));
}

TEST_CASE("the page's tables have a column for each factor, sort, filter, and save what they show", "[gl]") {
    if (!has_program("chromium"))
        OVERT_SKIP("no chromium here to open the report");
    const nlohmann::ordered_json seen = seen_of(test::made_up_study(), 1400);
    REQUIRE(seen.contains("csv"));
    const auto heads = seen["factors"].get<std::vector<std::string>>();
    for (const std::string factor : {"task", "material", "object"})
        CHECK(std::ranges::count(heads, factor) == 1);
    CHECK(seen["stuck"] == "sticky");
    CHECK(seen["focusable"] == true);
    const auto& sorted = seen["sorted"];
    auto up = sorted["before"].get<std::vector<std::string>>();
    std::ranges::sort(up, {}, [](const std::string& number) { return std::stod(number); });
    CHECK(sorted["up"].get<std::vector<std::string>>() == up);
    std::ranges::reverse(up);
    CHECK(sorted["down"].get<std::vector<std::string>>() == up);
    CHECK(sorted["after"] == sorted["before"]);
    const auto sorts = sorted["sorts"].get<std::vector<std::string>>();
    CHECK(sorts[0].find("ascending") == std::string::npos);
    CHECK(sorts[1].find("ascending") != std::string::npos);
    CHECK(sorts[2].find("descending") != std::string::npos);
    CHECK(sorts[3] == sorts[0]);
    CHECK(seen["filtered"]["rows"].dump() == R"(["rough","rough"])");
    CHECK(seen["filtered"]["said"] == R"(2 of 8 rows, those with "rough" and "free")");
    // The file has what is shown: both rows, with values and ends of intervals apart, to all digits of the
    // page.
    CHECK(seen["file"] == "figure_5.csv");
    const auto csv = seen["csv"].get<std::string>();
    CHECK(std::ranges::count(csv, '\n') == 3);
    CHECK(csv.starts_with("task,material,object,mean WSS / "));
    CHECK(csv.find(" low,mean WSS / ") != std::string::npos);
    CHECK(csv.find("free,rough,The ball,") != std::string::npos);
}

TEST_CASE("each figure of the page is saved by itself, in the widths of journals, as it is by day", "[gl]") {
    if (!has_program("chromium"))
        OVERT_SKIP("no chromium here to open the report");
    const nlohmann::ordered_json seen =
        seen_of(test::made_up_study(), 1000, "--blink-settings=preferredColorScheme=0");
    CHECK(seen["errors"].dump() == "[]");
    REQUIRE(seen["figures"].size() >= 16);
    for (const auto& figure : seen["figures"]) {
        INFO(figure.dump());
        CHECK(figure["name"].get<std::string>().ends_with(".svg"));
        CHECK(figure["width"] == figure["wanted"].get<std::string>() + "mm");
        // Letters of 8 points: twelve units of the drawing.
        CHECK(figure["pixels_wide"].get<double>() / std::stod(figure["wanted"].get<std::string>()) ==
              Approx(12 / (8 * 25.4 / 72)).epsilon(0.002));
        CHECK(figure["texts"] > 2);
        CHECK(figure["of_the_page"].dump() == "[]");
        CHECK(figure["unpainted"] == 0);
        CHECK(figure["apart"] == 0);
    }
    // The chunk after the header says 600 dots an inch, and its checksum is right.
    std::vector<std::uint8_t> png;
    for (const auto& byte : seen["png"])
        png.push_back(byte.get<std::uint8_t>());
    REQUIRE(png.size() > 54);
    const auto number_at = [&png](std::size_t at) {
        return std::uint32_t{png[at]} << 24 | std::uint32_t{png[at + 1]} << 16 |
               std::uint32_t{png[at + 2]} << 8 | std::uint32_t{png[at + 3]};
    };
    CHECK(std::string(png.begin() + 37, png.begin() + 41) == "pHYs");
    CHECK(number_at(33) == 9);
    CHECK(number_at(41) == 23622);
    CHECK(number_at(45) == 23622);
    CHECK(png[49] == 1);
    CHECK(number_at(50) == crc32(0, png.data() + 37, 13));
    CHECK(std::string(png.begin() + 58, png.begin() + 62) == "IDAT");
}

TEST_CASE("nothing of the page is cut or lies on something else, in windows of all widths, by day and night",
          "[gl]") {
    if (!has_program("chromium"))
        OVERT_SKIP("no chromium here to open the report");
    // Twelve groups with long names.
    StudyResults study = test::made_up_study();
    const auto rename = [](std::vector<StudyKey>& keys) {
        for (StudyKey& key : keys)
            if (key.column != "object")
                key.value += " of those who look for a person that has been here before";
    };
    for (StudyGroup& group : study.groups)
        rename(group.keys);
    for (AreaRow& row : study.area_rows)
        rename(row.keys);
    for (StudyTrial& trial : study.trials)
        rename(trial.keys);
    for (int i = 0; i < 12; ++i) {
        study.area_rows.push_back(study.area_rows.back());
        study.area_rows.back().keys = {{"task", fmt::format("{} and a task with a long name", i)}};
        for (int second = 0; second < 8; ++second) {
            study.time_course.push_back(study.time_course.front());
            study.time_course.back().key.value = fmt::format("{} and a task with a long name", i);
            study.time_course.back().from_s = second;
            study.time_course.back().to_s = second + 1;
        }
    }
    for (const auto& [width_px, options] : {std::pair<int, std::string>{390, ""},
                                            {1400, "--blink-settings=preferredColorScheme=0"},
                                            {1920, ""}}) {
        const nlohmann::ordered_json seen = seen_of(study, width_px, options);
        INFO(width_px << " px " << options);
        CHECK(seen["errors"].dump() == "[]");
        CHECK(seen["too_wide"] <= 0);
        CHECK(seen["texts_of_charts"] > 100);
        CHECK(seen["texts_apart"].dump() == "[]");
    }
}

TEST_CASE("on paper a ball is round, and its caption says what it shows", "[gl]") {
    if (!has_program("chromium") || !has_program("pdftoppm") || !has_program("pdftotext"))
        OVERT_SKIP("no chromium or no poppler-utils here to print the report");
    const test::TemporaryFolder folder;
    folder.file(
        "report.html",
        page_with(test::made_up_study(),
                  "<style>section:not(#maps), #legend, header { display: none !important; }</style>"));
    run_chromium(folder.path(), fmt::format("--window-size=1400,900 --no-pdf-header-footer "
                                            "--print-to-pdf=report.pdf file://{}/report.html",
                                            folder.path().string()));
    REQUIRE(
        std::system(fmt::format("cd {} && pdftoppm -r 60 -f 1 -l 1 report.pdf page && pdftotext report.pdf "
                                "&& mv page*.ppm page.ppm",
                                folder.path().string())
                        .c_str()) == 0);
    std::string text = read_whole_file(folder.path() / "report.txt");
    std::ranges::replace(text, '\n', ' ');
    CHECK(text.find("The ball: task free, material smooth") != std::string::npos);
    CHECK(text.find("The ball: task free, material rough") != std::string::npos);
    // The coloured places of each half of the page: one ball, seen from the front, where all of it is
    // coloured.
    const Pixels page = read_ppm(folder.path() / "page.ppm");
    for (const int half : {0, 1}) {
        glm::ivec2 low(page.width, page.height), high(0);
        for (int y = 0; y < page.height; ++y) {
            for (int x = half * page.width / 2; x < (half + 1) * page.width / 2; ++x) {
                const auto at = [&](int channel) {
                    return static_cast<int>(static_cast<unsigned char>(
                        page.rgb[static_cast<std::size_t>(3 * (y * page.width + x) + channel)]));
                };
                if (std::max({at(0), at(1), at(2)}) - std::min({at(0), at(1), at(2)}) < 30)
                    continue;
                low = glm::min(low, glm::ivec2(x, y));
                high = glm::max(high, glm::ivec2(x, y));
            }
        }
        const glm::dvec2 size = high - low + 1;
        INFO("half " << half << ": " << size.x << " x " << size.y << " px");
        CHECK(size.x > 60.0);
        CHECK(size.x / size.y == Approx(1.0).epsilon(0.06));
    }
}
