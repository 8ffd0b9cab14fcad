/// Hashing goes on beside the session, never in it. Counts calls of OpenSSL by taking their place.
#include <atomic>

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <openssl/evp.h>

#include "experiment/record/verify/verification.h"
#include "tests/experiment/record/sealed_session.h"

namespace {

thread_local long hashed_here = 0;
std::atomic<long> hashed_anywhere{0};

} // namespace

extern "C" int EVP_DigestUpdate(EVP_MD_CTX* ctx, const void* data, std::size_t cnt) {
    static auto* const next =
        reinterpret_cast<decltype(&EVP_DigestUpdate)>(dlsym(RTLD_NEXT, "EVP_DigestUpdate"));
    ++hashed_here;
    ++hashed_anywhere;
    return next(ctx, data, cnt);
}

using namespace overt;
using namespace overt::testing;

TEST_CASE("the seals over a trial's rows are computed by the writer's thread alone", "[unit]") {
    const TemporaryFolder root;
    const std::filesystem::path session = make_whole_session(root.path());
    const std::vector<Trial> trials = example_header().schedule.trials;
    {
        SessionStore store(session / session_file_name, patient());
        const long here = hashed_here, anywhere = hashed_anywhere;
        for (const Trial& trial : trials) {
            write_rows(store, trial, 2000);
            store.trial_finished(trial, outcome_at(trial.index * 10000));
        }
        CHECK(hashed_here == here);
        CHECK(hashed_anywhere > anywhere + 100);
        store.close();
    }
    CHECK(verify_session(session).is_sound());
}
