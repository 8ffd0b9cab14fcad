/// A bed of devices in the place of /sys and of nodes in /dev, for programs that run under umockdev-wrapper.
#pragma once

#include <stdexcept>
#include <string>

#include <umockdev.h>

namespace overt::test {

class UmockdevBed {
  public:
    UmockdevBed() : bed_(umockdev_testbed_new()) {}
    ~UmockdevBed() { g_object_unref(bed_); }
    UmockdevBed(const UmockdevBed&) = delete;
    UmockdevBed& operator=(const UmockdevBed&) = delete;

    void add(const std::string& devices) {
        GError* error = nullptr;
        if (!umockdev_testbed_add_from_string(bed_, devices.c_str(), &error))
            throw std::runtime_error(error->message);
    }
    /// The device's end of a tty.
    int far_end(const char* node) { return umockdev_testbed_get_dev_fd(bed_, node); }

    /// Has this answer what is asked of a node.
    void attach(const char* node, UMockdevIoctlBase* handler) {
        GError* error = nullptr;
        if (!umockdev_testbed_attach_ioctl(bed_, node, handler, &error))
            throw std::runtime_error(error->message);
    }

    void detach(const char* node) { umockdev_testbed_detach_ioctl(bed_, node, nullptr); }

  private:
    UMockdevTestbed* bed_;
};

} // namespace overt::test
