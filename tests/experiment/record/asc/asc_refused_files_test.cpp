/// Files that are no recordings, or lose more than they may: refused by name, with what helps.
#include "tests/experiment/record/asc/field_case.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::field_case;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("an import that would lose more than it may is refused, in all or of one recording", "[unit]") {
    ImportBench bench;
    AscExample example;
    const std::string sound = asc_text(example);
    const auto broken = [&](int from, int to, const char* begin) {
        std::string text;
        int n = 0;
        for (const std::string& line : lines_of(sound))
            text +=
                (line.starts_with(begin) && ++n > from && n <= to ? line.substr(0, 9) + "\tx" : line) + "\n";
        return text;
    };
    CHECK(samples_of(bench.import(broken(0, 6, "5"))).size() == 114);
    CHECK(bench.summary.survey.recordings.size() == 3);
    CHECK(bench.summary.survey.recordings[1].sample_lines == 60);
    CHECK(bench.summary.survey.recordings[1].samples_read == 54);
    CHECK(bench.summary.survey.recordings[2].samples_read == 60);
    const std::string bad = broken(0, 8, "5"), worse = broken(0, 14, "5"), no_events = broken(0, 9, "E");
    CHECK_THROWS_WITH(bench.import(bad),
                      Contains("52 of 60 lines of samples of the recording that began at 5000 ms") &&
                          Contains("--least-read"));
    CHECK_THROWS_WITH(bench.import(worse), Contains("106 of 120 lines of samples"));
    CHECK_THROWS_WITH(bench.import(no_events), Contains("lines of fixations, saccades and blinks"));
    CHECK_FALSE(fs::exists(bench.root.path() / fmt::format("session_{}", bench.sessions)));
    bench.reading.least_read = 0.7;
    CHECK(samples_of(bench.import(worse)).size() == 106);
    bench.reading.least_read = 0.0;
    CHECK(samples_of(bench.import(no_events)).size() == 120);
}

TEST_CASE("two files of different recordings are refused", "[unit]") {
    ImportBench bench;
    AscExample example;
    const auto halves = [&](const std::string& text, const std::string& name) {
        std::string of_samples, of_events;
        for (const std::string& line : lines_of(text))
            (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])) ? of_samples : of_events) +=
                line + "\n";
        return std::pair{bench.file(name + "_s.asc", of_samples), bench.file(name + "_e.asc", of_events)};
    };
    // The example's own fixation lies elsewhere: give it the place of its samples.
    const std::string text = replaced(asc_text(example), "\t  512.8\t  394.5\t   1063",
                                      "\t  101.7\t  694.9\t   1063"),
                      second = replaced(text, "EFIX L   7030\t7038\t10\t  101.7",
                                        "EFIX L   7030\t7038\t10\t  201.7");
    const auto one = halves(second, "one");
    CHECK(samples_of(bench.import(AscFiles(one.first, one.second))).size() == 120);
    // Another hour of the tracker's clock.
    std::string later = second;
    for (const char* const thousand : {"5", "7"})
        later = replaced(later, fmt::format("\n{}", thousand), fmt::format("\n1{}", thousand));
    const auto other = halves(later, "other");
    CHECK_THROWS_WITH(bench.import(AscFiles(other.first, one.second)),
                      Contains("not of one recording") && Contains("outside of the recordings"));
    // The same time, another observer.
    const auto elsewhere =
        halves(replaced(replaced(second, "\t  101.", "\t  901."), "\t  201.", "\t  801."), "where");
    CHECK_THROWS_WITH(bench.import(AscFiles(elsewhere.first, one.second)),
                      Contains("other places than the samples"));
}

TEST_CASE("samples that are no gaze are refused by name, with what helps", "[unit]") {
    ImportBench bench;
    std::vector<std::array<double, 3>> raw, angles;
    for (int n = 0; n < 100; ++n) {
        raw.push_back({300.0 + n, 200.0 + n, -900.0});
        angles.push_back({-2000.0 + 30 * n, -1500.0 + 3 * n, 900.0});
    }
    CHECK_THROWS_WITH(bench.import(made_recording(raw)), Contains("file_sample_raw_pcr"));
    CHECK_THROWS_WITH(bench.import(made_recording(angles, "HREF")), Contains("-sg"));
    CHECK_THROWS_WITH(bench.import(made_recording(raw, "PUPIL")), Contains("-sg"));
    std::string alone;
    for (const std::string& line : lines_of(made_recording(angles)))
        if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
            alone += line + "\n";
    CHECK_THROWS_WITH(bench.import(alone), Contains("lie off the screen") && Contains("--as-gaze"));
    bench.reading.is_gaze = true;
    CHECK(samples_of(bench.import(alone)).size() == 100);
    bench.reading.least_read = 0.0;
    CHECK(lost_of(samples_of(bench.import(made_recording(raw)))) == 100);
    CHECK(samples_of(bench.import(made_recording(angles, "HREF"))).empty());
}

TEST_CASE("files that are no plain text are refused by what they are, with the command that mends them",
          "[unit]") {
    ImportBench bench;
    const std::string text = asc_text({});
    std::string wide;
    for (const char c : text)
        wide += {c, '\0'};
    std::string wide_the_other_way;
    for (const char c : text)
        wide_the_other_way += {'\0', c};
    using namespace std::string_literals;
    for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::string>>{
             {"\xff\xfe" + wide, "UTF-16"},
             {"\xfe\xff" + wide_the_other_way, "UTF-16"},
             {wide, "UTF-16LE"},
             {wide_the_other_way, "UTF-16BE"},
             {"\xff\xfe\0\0"s + wide, "UTF-32"},
             {"\x1f\x8b\x08\x00\x00"s, "gzip -dc"},
             {"PK\x03\x04"s + text, "unzip"},
             {"BZh91AY", "bzip2"},
             {"\xfd"
              "7zXZ",
              "xz"},
             {replaced(text, "\n", "\r"), "carriage return"},
             {replaced(text, "\n", "\r") + "\n", "carriage return"}}) {
        CAPTURE(words);
        CHECK_THROWS_WITH(bench.import(bytes), Contains(words));
    }
    CHECK(samples_of(bench.import(replaced(text, "\n", "\r\n"))).size() == 120);
}
