#include <chrono>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/asc_text.h"
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
