/// A USB device behind the kernel's usbdevfs, made of a test's own answers: real libusb on the other side.
#pragma once

#include <cerrno>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include "tests/support/umockdev_bed.h"

namespace overt::test {

/// A serial chip of FTDI with one interface, at bus 1 as device 5. Answers come on umockdev's thread.
class UsbChip {
  public:
    static constexpr const char* node = "/dev/bus/usb/001/005";

    /// `heard` is told what is written, and the value of the last request for a speed, and gives what the
    /// device says to that. With `driver` the kernel's own
    /// driver has the interface.
    explicit UsbChip(std::function<std::string(const std::string& bytes, int speed)> heard,
                     std::string driver = {})
        : heard_(std::move(heard)), driver_(std::move(driver)), handler_(umockdev_ioctl_base_new()) {
        bed_.add(description());
        g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&UsbChip::on_ioctl), this);
        bed_.attach(node, handler_);
    }
    ~UsbChip() {
        bed_.detach(node);
        g_object_unref(handler_);
    }
    UsbChip(const UsbChip&) = delete;
    UsbChip& operator=(const UsbChip&) = delete;

    /// Says something without being asked.
    void say(const std::string& bytes) {
        const std::scoped_lock lock(mutex_);
        said_ += bytes;
    }
    void unplug() {
        const std::scoped_lock lock(mutex_);
        is_gone_ = true;
    }
    /// The value and the index of the last vendor request of this number.
    std::pair<int, int> last_request(int request) {
        const std::scoped_lock lock(mutex_);
        return requests_.at(request);
    }

  private:
    struct Urb {
        UMockdevIoctlData* urb;
        UMockdevIoctlData* buffer;
        gulong address;
        usbdevfs_urb& fields() const { return *reinterpret_cast<usbdevfs_urb*>(urb->data); }
    };

    static std::string hexadecimal(const std::vector<int>& bytes) {
        constexpr const char* digits = "0123456789ABCDEF";
        std::string text;
        for (const int byte : bytes)
            text += {digits[byte / 16], digits[byte % 16]};
        return text;
    }

    static std::string description() {
        // Device: USB 2.0, 64-byte packets, 0403:f1c0, texts 1 to 3, one configuration of one interface with
        // two bulk endpoints.
        const std::string descriptors =
            hexadecimal({18, 1, 0, 2, 0, 0, 0, 64, 0x03, 0x04, 0xC0, 0xF1, 0, 6, 1, 2, 3, 1}) +
            hexadecimal({9,   2, 32, 0, 1,    1, 0,  0x80, 45, 9, 4, 0,    0, 2,  255, 255,
                         255, 2, 7,  5, 0x81, 2, 64, 0,    0,  7, 5, 0x02, 2, 64, 0,   0});
        return "P: /devices/pci0000:00/0000:00:14.0/usb1/1-5\nN: bus/usb/001/005\nE: SUBSYSTEM=usb\n"
               "E: DEVTYPE=usb_device\nE: DEVNAME=/dev/bus/usb/001/005\nE: BUSNUM=001\nE: DEVNUM=005\n"
               "E: MAJOR=189\nE: MINOR=4\nE: PRODUCT=403/f1c0/600\nA: busnum=1\\n\nA: devnum=5\\n\nA: "
               "speed=12\\n\n"
               "A: bConfigurationValue=1\\n\nA: idVendor=0403\\n\nA: idProduct=f1c0\\n\nH: descriptors=" +
               descriptors + "\n";
    }

    static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer pointer) {
        return static_cast<UsbChip*>(pointer)->answer(client);
    }

    gboolean answer(UMockdevIoctlClient* client) {
        const std::scoped_lock lock(mutex_);
        UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
        const auto complete = [&](int error) {
            umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
            return TRUE;
        };
        switch (umockdev_ioctl_client_get_request(client)) {
        case USBDEVFS_GET_CAPABILITIES: {
            UMockdevIoctlData* const wanted = umockdev_ioctl_data_resolve(argument, 0, 4, nullptr);
            *reinterpret_cast<guint32*>(wanted->data) = USBDEVFS_CAP_ZERO_PACKET |
                                                        USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                                        USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
            return complete(0);
        }
        case USBDEVFS_GETDRIVER: {
            if (driver_.empty())
                return complete(ENODATA);
            UMockdevIoctlData* const wanted =
                umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_getdriver), nullptr);
            auto& found = *reinterpret_cast<usbdevfs_getdriver*>(wanted->data);
            driver_.copy(found.driver, driver_.size());
            found.driver[driver_.size()] = 0;
            return complete(0);
        }
        case USBDEVFS_CLAIMINTERFACE:
        case USBDEVFS_RELEASEINTERFACE:
            return complete(0);
        case USBDEVFS_SUBMITURB: {
            const gulong address = *reinterpret_cast<gulong*>(argument->data);
            UMockdevIoctlData* const urb =
                umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
            const auto& fields = *reinterpret_cast<usbdevfs_urb*>(urb->data);
            UMockdevIoctlData* const buffer = umockdev_ioctl_data_resolve(
                urb, offsetof(usbdevfs_urb, buffer), static_cast<gsize>(fields.buffer_length), nullptr);
            g_object_ref(urb);
            if (buffer)
                g_object_ref(buffer);
            waiting_.push_back({urb, buffer, address});
            go_on();
            return complete(is_gone_ ? ENODEV : 0);
        }
        case USBDEVFS_DISCARDURB: {
            const gulong address = *reinterpret_cast<gulong*>(argument->data);
            for (auto at = waiting_.begin(); at != waiting_.end(); ++at) {
                if (at->address != address)
                    continue;
                at->fields().status = -ENOENT;
                done_.push_back(*at);
                waiting_.erase(at);
                return complete(0);
            }
            return complete(EINVAL);
        }
        case USBDEVFS_REAPURB:
        case USBDEVFS_REAPURBNDELAY: {
            go_on();
            if (done_.empty())
                return complete(is_gone_ ? ENODEV : EAGAIN);
            UMockdevIoctlData* const place = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
            umockdev_ioctl_data_set_ptr(place, 0, done_.front().urb);
            done_.pop_front();
            return complete(0);
        }
        default:
            return FALSE;
        }
    }

    /// Answers what can be answered.
    void go_on() {
        for (auto at = waiting_.begin(); at != waiting_.end();) {
            if (is_answered(*at)) {
                done_.push_back(*at);
                at = waiting_.erase(at);
            } else {
                ++at;
            }
        }
    }

    bool is_answered(const Urb& urb) {
        usbdevfs_urb& fields = urb.fields();
        fields.status = 0;
        if (is_gone_) {
            fields.status = -ENODEV;
            return true;
        }
        if (fields.type == USBDEVFS_URB_TYPE_CONTROL)
            return answer_control(fields, urb.buffer->data);
        if (fields.endpoint == 0x02) {
            fields.actual_length = fields.buffer_length;
            said_ += heard_({reinterpret_cast<const char*>(urb.buffer->data),
                             static_cast<std::size_t>(fields.buffer_length)},
                            requests_[3].first);
            return true;
        }
        // In packets of 64 bytes, each of which begins with two of status.
        if (said_.empty())
            return false;
        std::string packets;
        while (!said_.empty() && packets.size() + 64 <= static_cast<std::size_t>(fields.buffer_length)) {
            packets += std::string("\x01\x60", 2) + said_.substr(0, 62);
            said_.erase(0, 62);
        }
        packets.copy(reinterpret_cast<char*>(urb.buffer->data), packets.size());
        fields.actual_length = static_cast<int>(packets.size());
        return true;
    }

    bool answer_control(usbdevfs_urb& fields, unsigned char* bytes) {
        fields.actual_length = 0;
        if (bytes[0] == 0x40) {
            requests_[bytes[1]] = {bytes[2] + 256 * bytes[3], bytes[4] + 256 * bytes[5]};
        } else if (bytes[0] == 0x80 && bytes[1] == 6 && bytes[3] == 3) { // a text
            std::string text("\x04\x03\x09\x04", 4);
            if (bytes[2] != 0) {
                text.clear();
                for (const char letter : std::string(bytes[2] == 2 ? "RB-740" : "AB12"))
                    text += {letter, '\0'};
                text = std::string{static_cast<char>(text.size() + 2), '\x03'} + text;
            }
            const auto length = std::min(text.size(), static_cast<std::size_t>(fields.buffer_length - 8));
            text.copy(reinterpret_cast<char*>(bytes) + 8, length);
            fields.actual_length = static_cast<int>(length);
        } else {
            fields.status = -EPIPE;
        }
        return true;
    }

    std::mutex mutex_;
    std::function<std::string(const std::string&, int)> heard_;
    std::string driver_, said_;
    bool is_gone_ = false;
    std::map<int, std::pair<int, int>> requests_;
    std::deque<Urb> waiting_, done_;
    UmockdevBed bed_;
    UMockdevIoctlBase* handler_;
};

} // namespace overt::test
