#include <chrono>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/asc_text.h"
#include "tests/support/program.h"
#include "tests/support/running_program.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

bool has_partial_folder(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().find(".partial-") != std::string::npos)
            return true;
    return false;
}

} // namespace

TEST_CASE("an import that is interrupted leaves nothing behind, and says so", "[session]") {
    const test::TemporaryFolder root;
    const fs::path out = root.path() / "session", said = root.path() / "said";
    const auto interrupted_import = [&](int trials) {
        AscExample example;
        example.rate_hz = 1000.0, example.trials = trials, example.samples = 1900;
        const fs::path file = write_asc(root.path() / "long.asc", asc_text(example));
        test::RunningProgram program({"import", file.string(), "--out", out.string()}, {}, said);
        while (program.is_running() && !has_partial_folder(root.path()))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        program.signal(SIGINT);
        return program.wait();
    };
    // On a busy machine the import may be over before it is interrupted.
    int code = interrupted_import(60);
    for (int trials = 120; code == 0 && trials <= 960; trials *= 2) {
        fs::remove_all(out);
        code = interrupted_import(trials);
    }
    CHECK(code == 1);
    CHECK_FALSE(fs::exists(out));
    CHECK_FALSE(has_partial_folder(root.path()));
    std::ifstream stream(said);
    CHECK_THAT((std::string{std::istreambuf_iterator<char>(stream), {}}),
               Catch::Matchers::Contains("The import was interrupted"));
}

TEST_CASE("an import says of each recording how many of its lines were read", "[session]") {
    const test::TemporaryFolder root;
    std::string text = asc_text({});
    // A sample and an event of the second recording are broken.
    const std::size_t sample = text.find("\n7010\t"), event = text.find("EFIX L   7030");
    REQUIRE(sample != std::string::npos);
    REQUIRE(event != std::string::npos);
    text.replace(event, 13, "EFIX L   x030");
    text.insert(sample + 6, "x");
    const fs::path file = write_asc(root.path() / "p07.asc", text);
    const test::ProgramRun run =
        test::run_overt({"import", file.string(), "--out", (root.path() / "session").string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out,
               Catch::Matchers::Contains("recording 1, from 5000 ms: 60 of 60 samples' lines read") &&
                   Catch::Matchers::Contains("recording 2, from 7000 ms: 59 of 60 samples' lines read"));
    CHECK_THAT(run.out, Catch::Matchers::Contains("2 of 3 events' lines\n"));
}

TEST_CASE("an import of a file whose name is no observer's asks for one", "[session]") {
    const test::TemporaryFolder root;
    const fs::path file = write_asc(root.path() / "__-.asc", asc_text({})), said = root.path() / "said",
                   out = root.path() / "session";
    CHECK(test::RunningProgram({"import", file.string(), "--out", out.string()}, {}, said).wait() == 2);
    std::ifstream stream(said);
    CHECK_THAT((std::string{std::istreambuf_iterator<char>(stream), {}}),
               Catch::Matchers::Contains("--observer"));
    CHECK(test::RunningProgram({"import", file.string(), "--out", out.string(), "--observer", "07"}, {}, said)
              .wait() == 0);
}
