#include "experiment/base/output_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include "experiment/base/error.h"

namespace overt {

struct OutputFile::Packer {
    Packer() {
        constexpr int level = 6, gzip_window = 15 + 16, memory = 8;
        OVERT_EXPECTS(deflateInit2(&stream, level, Z_DEFLATED, gzip_window, memory, Z_DEFAULT_STRATEGY) ==
                      Z_OK);
    }
    ~Packer() { deflateEnd(&stream); }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;

    /// Gives what comes out of the text to `write`; at the end all that is left.
    template <class Write> void pack(std::string_view text, bool is_end, const Write& write) {
        // zlib promises not to write through this pointer.
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
        stream.avail_in = static_cast<uInt>(text.size());
        do {
            stream.next_out = reinterpret_cast<Bytef*>(packed.data());
            stream.avail_out = static_cast<uInt>(packed.size());
            OVERT_EXPECTS(deflate(&stream, is_end ? Z_FINISH : Z_NO_FLUSH) != Z_STREAM_ERROR);
            write(std::string_view(packed.data(), packed.size() - stream.avail_out));
        } while (stream.avail_out == 0);
    }

    z_stream stream{};
    std::array<char, 65536> packed;
};

OutputFile::OutputFile(const std::filesystem::path& path, Packing packing)
    : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0)
        throw RecordError(fmt::format("{}: cannot be made: {}. Check the folder's permissions.",
                                      path_.string(), std::strerror(errno)));
    if (packing == Packing::gzip)
        packer_ = std::make_unique<Packer>();
    text_.reserve(piece_bytes + 4096);
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR)
            throw RecordError(fmt::format("{}: writing failed: {}. Check the disk's space.", path_.string(),
                                          std::strerror(errno)));
        if (count > 0)
            bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

void OutputFile::flush() {
    flushed_ += static_cast<std::int64_t>(text_.size());
    if (packer_)
        packer_->pack(text_, false, [this](std::string_view packed) { write(packed); });
    else
        write(text_);
    text_.clear();
}

void OutputFile::close() {
    flush();
    if (packer_)
        packer_->pack({}, true, [this](std::string_view packed) { write(packed); });
    const int descriptor = std::exchange(descriptor_, -1);
    // Some file systems say only now that the disk is full.
    if (::close(descriptor) != 0)
        throw RecordError(fmt::format("{}: writing failed: {}. Check the disk's space.", path_.string(),
                                      std::strerror(errno)));
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
    OutputFile file(path);
    file.text() += text;
    file.close();
}

} // namespace overt
