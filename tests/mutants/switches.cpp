// Linked with a changed program: which change is on, and which were reached, each test by itself. The bytes
// of what was reached are a file that programs started by tests share.
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>

#include <cstdio>
#include <cstring>
#include <string>

extern unsigned char* overt_mutants_reached;
extern unsigned overt_mutants_count;

namespace {

struct Reached : Catch::TestEventListenerBase {
    using TestEventListenerBase::TestEventListenerBase;

    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        TestEventListenerBase::testCaseStarting(info);
        // Numbers with a name are asked for before the first test.
        if (const char* const path = std::getenv("OVERT_MUTANTS_TESTS"); path != nullptr && is_first_)
            write_row(path, "\t\t0\tbefore\t");
        is_first_ = false;
        std::memset(overt_mutants_reached, 0, overt_mutants_count);
        timer_.start();
    }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        TestEventListenerBase::testCaseEnded(stats);
        const char* const path = std::getenv("OVERT_MUTANTS_TESTS");
        if (path == nullptr)
            return;
        std::string row = stats.testInfo.name + "\t" + stats.testInfo.lineInfo.file + "\t" +
                          std::to_string(timer_.getElapsedSeconds()) + "\t" +
                          (stats.totals.assertions.failed > 0 ? "failed" : "passed") + "\t";
        write_row(path, row);
    }

  private:
    static void write_row(const char* path, std::string row) {
        for (unsigned i = 1; i < overt_mutants_count; ++i)
            if (overt_mutants_reached[i] != 0)
                row += std::to_string(i) + " ";
        if (std::FILE* const file = std::fopen(path, "a")) {
            std::fprintf(file, "%s\n", row.c_str());
            std::fclose(file);
        }
    }

    Catch::Timer timer_;
    bool is_first_ = true;
};

CATCH_REGISTER_LISTENER(Reached)

} // namespace
