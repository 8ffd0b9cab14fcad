// Runs under umockdev-wrapper: hidapi finds, opens, asks, reads and loses HID devices by the calls that it
// makes on any machine; what the kernel would answer is answered here.
#include <array>
#include <clocale>
#include <cstring>
#include <mutex>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "devices/buttons/hid_box_search.h"
#include "devices/buttons/iolab_box.h"
#include "devices/hid/hid_driver.h"
#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "tests/devices/hid/hid_bytes.h"
#include "tests/support/kept_items.h"
#include "tests/support/umockdev_bed.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// The kernel's side of a hidraw node. Its callbacks run in a thread of umockdev's.
class HidrawNode {
  public:
    HidrawNode(UmockdevBed& bed, int number, const char* vendor, const char* product_id, const char* product,
               std::vector<std::byte> descriptor)
        : descriptor_(std::move(descriptor)) {
        std::string hex;
        for (const std::byte byte : descriptor_)
            hex += fmt::format("{:02X}", std::to_integer<int>(byte));
        const std::string usb = fmt::format("/devices/pci0000:00/0000:00:14.0/usb1/1-{}", number + 1);
        const std::string hid = fmt::format("0003:{}:{}.{:04}", vendor, product_id, number + 1);
        node_ = fmt::format("/dev/hidraw{}", number);
        bed.add(fmt::format(
            "P: {0}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor={1}\nA: idProduct={2}\n"
            "A: manufacturer=Overt Test\nA: product={3}\nA: serial=S{4}\nA: bcdDevice=0100\n\n"
            "P: {0}/1-{7}:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nA: bInterfaceNumber=00\n\n"
            "P: {0}/1-{7}:1.0/{5}\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000{1}:0000{2}\n"
            "E: HID_NAME={3}\nE: HID_UNIQ=S{4}\nH: report_descriptor={6}\n\n"
            "P: {0}/1-{7}:1.0/{5}/hidraw/hidraw{4}\nN: hidraw{4}\nE: SUBSYSTEM=hidraw\n"
            "E: DEVNAME=/dev/hidraw{4}\nE: MAJOR=244\nE: MINOR={4}\nA: dev=244:{4}\n"
            "L: device=../../../{5}\n",
            usb, vendor, product_id, product, number, hid, hex, number + 1));
        // One byte in the terminal behind the node for each report that waits: so it can be polled.
        far_end_ = bed.far_end(node_.c_str());
        std::array<char, 64> name{};
        ptsname_r(far_end_, name.data(), name.size());
        near_end_ = open(name.data(), O_RDWR | O_NOCTTY | O_NONBLOCK);
        handler_ = umockdev_ioctl_base_new();
        g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
        g_signal_connect(handler_, "handle-read", G_CALLBACK(on_read), this);
        g_signal_connect(handler_, "handle-write", G_CALLBACK(on_write), this);
        bed.attach(node_.c_str(), handler_);
    }
    HidrawNode(const HidrawNode&) = delete;
    HidrawNode& operator=(const HidrawNode&) = delete;
    ~HidrawNode() { close(near_end_); }

    void send(std::vector<std::byte> report) {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(report));
        const char token = 1;
        if (write(far_end_, &token, 1) != 1)
            throw std::runtime_error("the terminal takes no byte");
    }
    void unplug() {
        close(near_end_);
        close(far_end_);
        near_end_ = -1;
    }

    std::map<int, std::vector<std::byte>> features;
    std::vector<std::vector<std::byte>> features_sent;
    std::function<std::vector<std::byte>(std::span<const std::byte>)> answer; ///< to an output report

  private:
    static HidrawNode& node_of(gpointer user) { return *static_cast<HidrawNode*>(user); }

    static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
        HidrawNode& node = node_of(user);
        const gulong request = umockdev_ioctl_client_get_request(client);
        UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
        const auto at = [&](std::size_t bytes) {
            return umockdev_ioctl_data_resolve(argument, 0, bytes, nullptr)->data;
        };
        const auto number = _IOC_NR(request);
        const std::size_t length = _IOC_SIZE(request);
        if (request == HIDIOCGRDESCSIZE) {
            const int size = static_cast<int>(node.descriptor_.size());
            std::memcpy(at(sizeof size), &size, sizeof size);
            umockdev_ioctl_client_complete(client, 0, 0);
        } else if (number == _IOC_NR(HIDIOCGFEATURE(0))) {
            guint8* const report = at(length);
            const auto found = node.features.find(report[0]);
            if (found == node.features.end() || found->second.size() > length) {
                umockdev_ioctl_client_complete(client, -1, EPIPE);
            } else {
                std::memcpy(report, found->second.data(), found->second.size());
                umockdev_ioctl_client_complete(client, static_cast<glong>(found->second.size()), 0);
            }
        } else if (number == _IOC_NR(HIDIOCSFEATURE(0))) {
            const auto* report = reinterpret_cast<const std::byte*>(at(length));
            node.features_sent.emplace_back(report, report + length);
            umockdev_ioctl_client_complete(client, static_cast<glong>(length), 0);
        } else {
            return FALSE;
        }
        return TRUE;
    }
    static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
        HidrawNode& node = node_of(user);
        UMockdevIoctlData* into = umockdev_ioctl_client_get_arg(client);
        const std::lock_guard lock(node.mutex_);
        char token = 0;
        if (node.waiting_.empty() || read(node.near_end_, &token, 1) != 1) {
            umockdev_ioctl_client_complete(client, -1, node.near_end_ < 0 ? EIO : EAGAIN);
            return TRUE;
        }
        const std::vector<std::byte> report = std::move(node.waiting_.front());
        node.waiting_.pop_front();
        const std::size_t length = std::min(report.size(), static_cast<std::size_t>(into->data_len));
        std::memcpy(into->data, report.data(), length);
        umockdev_ioctl_client_complete(client, static_cast<glong>(length), 0);
        return TRUE;
    }
    static gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
        HidrawNode& node = node_of(user);
        UMockdevIoctlData* from = umockdev_ioctl_client_get_arg(client);
        const auto* bytes = reinterpret_cast<const std::byte*>(from->data);
        const std::vector<std::byte> report(bytes, bytes + from->data_len);
        umockdev_ioctl_client_complete(client, static_cast<glong>(report.size()), 0);
        if (node.answer)
            if (std::vector<std::byte> reply = node.answer(report); !reply.empty())
                node.send(std::move(reply));
        return TRUE;
    }

    std::vector<std::byte> descriptor_;
    std::string node_;
    int far_end_ = -1, near_end_ = -1;
    UMockdevIoctlBase* handler_ = nullptr;
    std::mutex mutex_;
    std::deque<std::vector<std::byte>> waiting_;
};

} // namespace

TEST_CASE("a HID eye tracker is found by hidapi, asked, read and lost", "[unit]") {
    UmockdevBed bed;
    REQUIRE(umockdev_in_mock_environment()); // that is, under umockdev-wrapper
    HidrawNode keyboard(bed, 0, "046D", "C31C", "Keyboard", keyboard_descriptor());
    HidrawNode tracker(bed, 1, "1209", "0E7E", "Mock Eye Tracker", eye_tracker_descriptor());
    tracker.features[0x12] = bytes_of({0x12, 0x20, 0xA1, 0x07, 0, 0x90, 0xD0, 0x03, 0});
    tracker.features[0x13] = bytes_of({0x13, 1, 0xF4, 0x01});
    const auto devices = hid_devices();
    REQUIRE(devices.size() == 2);
    CHECK(describe(devices[1]) == "/dev/hidraw1 (1209:0e7e Mock Eye Tracker)");
    CHECK(hid_descriptor_of("/dev/hidraw1") == eye_tracker_descriptor());

    SteadyClock clock;
    HidDriver driver({}, clock);
    TrackerWish wish;
    wish.screen.screen_px = {1000, 500};
    const TrackerDescription granted = driver.connect(wish);
    CHECK(granted.sample_rate_hz == 500.0);
    CHECK_THAT(granted.model, Catch::Contains("Mock Eye Tracker") && Catch::Contains("S1"));
    REQUIRE(tracker.features_sent.size() == 1);
    CHECK(tracker.features_sent[0] == bytes_of({0x14, 3}));

    driver.start();
    KeptItems kept;
    for (int i = 0; i < 200; ++i) {
        std::vector<std::byte> report(53);
        report[0] = std::byte{0x10};
        const std::uint64_t us = 1'000'000 + 2'000u * static_cast<unsigned>(i);
        const std::int32_t x_um = 1000 * i, y_um = 125'000;
        std::memcpy(report.data() + 1, &us, 8);
        std::memcpy(report.data() + 9, &x_um, 4);
        std::memcpy(report.data() + 13, &y_um, 4);
        tracker.send(report);
        if (i % 10 == 9)
            CHECK(driver.read(kept, clock.now() + 1ms) == RecordingState::running);
    }
    while (kept.all<GazeSample>().size() < 200 && clock.now() < SessionTime(20s))
        driver.read(kept, clock.now() + 10ms);
    const auto samples = kept.all<GazeSample>();
    REQUIRE(samples.size() == 200);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        wrong += samples[i].sampled_at != tracker_time(1'000'000 + 2'000 * static_cast<std::int64_t>(i)) ||
                 !samples[i].gaze || std::abs(samples[i].gaze->x_px - 2.0 * static_cast<double>(i)) > 1e-9;
    CHECK(wrong == 0);
    const SessionTime before = clock.now();
    CHECK(driver.read(kept, before + 20ms) == RecordingState::running);
    CHECK(clock.now() - before >= 19ms); // waits until its deadline and not for ever
    tracker.unplug();
    RecordingState state = RecordingState::running;
    for (int i = 0; i < 50 && state == RecordingState::running; ++i)
        state = driver.read(kept, clock.now() + 10ms);
    CHECK(state == RecordingState::lost);
}

TEST_CASE("an ioLab box answers through hidapi", "[unit]") {
    UmockdevBed bed;
    HidrawNode node(bed, 0, "19BC", "0001", "USBBox",
                    DescriptorText()
                        .item(0x04, 0xFF00, 2)
                        .open(1, 1)
                        .logical(0, 255)
                        .size(8, 8)
                        .usage(1)
                        .input(2)
                        .usage(1)
                        .item(0x90, 2)
                        .close()
                        .bytes);
    node.answer = [&](std::span<const std::byte> report) {
        const char command = static_cast<char>(report[1]);
        if (report.size() != 9 || (command != 'Y' && command != 'T'))
            return std::vector<std::byte>{};
        return bytes_of({command, 0, 0, 0, 0, 0, 4, 0xD2});
    };
    SteadyClock clock;
    IolabBox box(open_hid("/dev/hidraw0", clock), clock);
    box.begin();
    node.send(bytes_of({'D', 0, 0, 2, 0, 0, 5, 0}));
    node.send(bytes_of({'U', 0, 0, 2, 0, 0, 5, 9}));
    std::array<ButtonChange, 4> changes;
    std::size_t count = 0;
    while (count < 2 && clock.now() < SessionTime(20s))
        count += box.poll(std::span(changes).subspan(count));
    REQUIRE(count == 2);
    CHECK(changes[0].button == 3);
    CHECK(changes[0].is_down);
    CHECK_FALSE(changes[1].is_down);
    CHECK_THROWS_WITH(open_hid("/dev/hidraw7", clock),
                      Catch::Contains("There is no HID device /dev/hidraw7"));
}

TEST_CASE("boxes on HID are found by their kind, and one by its numbers, its path or as the only ioLab box",
          "[unit]") {
    UmockdevBed bed;
    const std::string before = std::setlocale(LC_CTYPE, nullptr);
    REQUIRE(std::setlocale(LC_CTYPE, "C.UTF-8")); // by which the library reads names
    const std::string name = "K\u00e4stchen \u20ac \U0001F441 \u07ff\u0800\ue000\uffff\U00010000";
    const std::vector<std::byte> plain = DescriptorText()
                                             .item(0x04, 0xFF00, 2)
                                             .open(1, 1)
                                             .logical(0, 255)
                                             .size(8, 8)
                                             .usage(1)
                                             .input(2)
                                             .close()
                                             .bytes;
    HidrawNode keyboard(bed, 0, "046D", "C31C", name.c_str(), keyboard_descriptor());
    HidrawNode iolab(bed, 1, "19BC", "0001", "USBBox", plain);
    HidrawNode other(bed, 2, "19BC", "0002", "Other", plain);
    const std::vector<std::string> found = hid_boxes_found();
    std::setlocale(LC_CTYPE, before.c_str());
    CHECK(found ==
          std::vector<std::string>{"/dev/hidraw0 (046d:c31c " + name + "): kind hid, address 046d:c31c",
                                   "/dev/hidraw1 (19bc:0001 USBBox): kind iolab"});
    ButtonBoxSettings box;
    box.id = "buttons";
    CHECK(find_hid_box(box).path == "/dev/hidraw1");
    box.address = "19bc:0002";
    CHECK(find_hid_box(box).path == "/dev/hidraw2");
    box.address = "/dev/hidraw0";
    CHECK(find_hid_box(box).product_id == 0xC31C);
    box.address = "19bc:0003";
    CHECK_THROWS_WITH(find_hid_box(box),
                      Catch::StartsWith("No HID device 19bc:0003 is plugged in. HID devices that are: "
                                        "/dev/hidraw0 (046d:c31c") &&
                          Catch::Contains(", /dev/hidraw1 (19bc:0001 USBBox), /dev/hidraw2"));
    box.address = "somewhere";
    CHECK_THROWS_WITH(find_hid_box(box),
                      Catch::Contains("[[button_box]] \"buttons\": \"somewhere\" is no HID device"));
}

TEST_CASE("without any HID device it is said that there is none", "[unit]") {
    UmockdevBed bed;
    CHECK(hid_boxes_found().empty());
    ButtonBoxSettings box;
    CHECK_THROWS_WITH(find_hid_box(box), "No ioLab box is plugged in. HID devices that are: none.");
}
