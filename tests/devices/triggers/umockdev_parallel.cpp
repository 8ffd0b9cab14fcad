// Runs under umockdev-wrapper: a parallel port that is made of the test's own answers to the kernel's calls.
#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <linux/ppdev.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include "devices/host/clocks.h"
#include "devices/triggers/parallel_trigger.h"
#include "devices/triggers/threaded_marker_sink.h"
#include "experiment/base/error.h"

using namespace overt;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// What ppdev was asked for.
struct AskedOfPort {
    std::mutex mutex;
    std::vector<int> data;
    int claims = 0, releases = 0, exclusive = 0, inward = 0;
    int refused = 0; ///< errno for what is claimed or written
};

gboolean answer_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer pointer) {
    auto& asked = *static_cast<AskedOfPort*>(pointer);
    const std::scoped_lock lock(asked.mutex);
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    int error = 0;
    switch (umockdev_ioctl_client_get_request(client)) {
    case PPEXCL:
        ++asked.exclusive;
        break;
    case PPCLAIM:
        ++asked.claims;
        error = asked.refused;
        break;
    case PPRELEASE:
        ++asked.releases;
        break;
    case PPDATADIR:
        asked.inward = umockdev_ioctl_data_resolve(argument, 0, sizeof(int), nullptr)->data[0];
        break;
    case PPWDATA:
        asked.data.push_back(umockdev_ioctl_data_resolve(argument, 0, 1, nullptr)->data[0]);
        error = asked.refused;
        break;
    default:
        return FALSE;
    }
    umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
    return TRUE;
}

class MockedPort {
  public:
    MockedPort() : bed_(umockdev_testbed_new()), handler_(umockdev_ioctl_base_new()) {
        GError* error = nullptr;
        umockdev_testbed_add_from_string(bed_,
                                         "P: /devices/pnp0/parport0\nN: parport0\nE: SUBSYSTEM=ppdev\n"
                                         "E: DEVNAME=/dev/parport0\nE: MAJOR=99\nE: MINOR=0\nA: dev=99:0\n",
                                         &error);
        REQUIRE_FALSE(error);
        g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(answer_ioctl), &asked);
        umockdev_testbed_attach_ioctl(bed_, "/dev/parport0", handler_, &error);
        REQUIRE_FALSE(error);
    }
    ~MockedPort() {
        umockdev_testbed_detach_ioctl(bed_, "/dev/parport0", nullptr);
        g_object_unref(handler_);
        g_object_unref(bed_);
    }
    MockedPort(const MockedPort&) = delete;
    MockedPort& operator=(const MockedPort&) = delete;

    AskedOfPort asked;

  private:
    UMockdevTestbed* bed_;
    UMockdevIoctlBase* handler_;
};

} // namespace

TEST_CASE(
    "a parallel trigger claims its port, raises each code on its lines, takes it back, and releases it") {
    SteadyClock clock;
    MockedPort port;
    {
        ThreadedMarkerSink sink(std::make_unique<ParallelTrigger>("/dev/parport0"), clock, {1ms, 1ms});
        CHECK(sink.name() == "parallel port /dev/parport0");
        sink.mark({clock.now(), 5, ""});
        sink.mark({clock.now(), 255, ""});
        CHECK(sink.finish().empty());
    }
    const std::scoped_lock lock(port.asked.mutex);
    CHECK(port.asked.exclusive == 1);
    CHECK(port.asked.claims == 1);
    CHECK(port.asked.releases == 1);
    CHECK(port.asked.inward == 0);
    CHECK(port.asked.data == std::vector<int>{0, 5, 0, 255, 0, 0});
}

TEST_CASE("a parallel port that another driver has is refused with a remedy") {
    MockedPort port;
    port.asked.refused = EBUSY;
    CHECK_THROWS_WITH(ParallelTrigger("/dev/parport0"),
                      Contains("/dev/parport0 cannot be had") && Contains("rmmod lp"));
}

TEST_CASE("a parallel port that does not take a code any more is told") {
    SteadyClock clock;
    MockedPort port;
    ThreadedMarkerSink sink(std::make_unique<ParallelTrigger>("/dev/parport0"), clock, {1ms, 1ms});
    port.asked.refused = ENXIO;
    sink.mark({clock.now(), 5, ""});
    const auto said = sink.finish();
    REQUIRE(said.size() == 1);
    CHECK_THAT(said.front(), Contains("1 marker could not be sent: No such device"));
}
