/// What a virtual screen shows, read from the framebuffer that Xvfb keeps in a file, as a cable carries it to
/// a display.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace overt::test {

class SeenScreen {
  public:
    /// `folder`: what VirtualScreen was given. The file is an X window dump (XWDFile.h, version 7).
    explicit SeenScreen(const std::filesystem::path& folder) {
        const int file = open((folder / "Xvfb_screen0").c_str(), O_RDONLY);
        struct stat facts {};
        if (file < 0 || fstat(file, &facts) != 0)
            throw std::runtime_error("Xvfb keeps no framebuffer in this folder");
        size_ = static_cast<std::size_t>(facts.st_size);
        bytes_ = static_cast<const std::uint8_t*>(mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0));
        close(file);
        width_ = static_cast<int>(header(4));
        height_ = static_cast<int>(header(5));
        stride_ = header(12);
        constexpr std::size_t bytes_per_colour = 12;
        pixels_ = bytes_ + header(0) + bytes_per_colour * header(19);
        if (header(1) != 7 || header(11) != 32)
            throw std::runtime_error("Xvfb's framebuffer has another form than expected");
    }
    ~SeenScreen() { munmap(const_cast<std::uint8_t*>(bytes_), size_); }
    SeenScreen(const SeenScreen&) = delete;
    SeenScreen& operator=(const SeenScreen&) = delete;

    int width() const { return width_; }
    int height() const { return height_; }

    /// Red, green and blue of a pixel, from the top left.
    std::array<std::uint8_t, 3> at(int x, int y) const {
        const volatile std::uint8_t* pixel =
            pixels_ + stride_ * static_cast<std::size_t>(y) + 4 * static_cast<std::size_t>(x);
        return {pixel[2], pixel[1], pixel[0]}; // least significant byte first
    }

    /// The top rows, four bytes to a pixel, red first.
    std::vector<std::byte> top_rows(int rows) const {
        std::vector<std::byte> all;
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < width_; ++x) {
                for (const std::uint8_t byte : at(x, y))
                    all.push_back(std::byte{byte});
                all.push_back(std::byte{255});
            }
        }
        return all;
    }

  private:
    std::size_t header(std::size_t index) const {
        return ntohl(reinterpret_cast<const std::uint32_t*>(bytes_)[index]);
    }

    const std::uint8_t* bytes_ = nullptr;
    const std::uint8_t* pixels_ = nullptr;
    std::size_t size_ = 0, stride_ = 0;
    int width_ = 0, height_ = 0;
};

} // namespace overt::test
