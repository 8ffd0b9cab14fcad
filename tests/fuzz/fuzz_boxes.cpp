// What comes from an EyeLink's library, from an ioLab box and from an XID box, in any bytes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "devices/buttons/iolab_box.h"
#include "devices/buttons/xid_box.h"
#include "devices/eyelink/eyelink_items.h"
#include "devices/eyelink/eyelink_words.h"
#include "tests/support/kept_items.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace overt;
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    parse_iolab(bytes);

    // In pieces of a length that the first byte says: the same keys as in one.
    const std::size_t piece = size > 0 ? 1 + data[0] % 16 : 1;
    XidParser parser;
    for (std::size_t at = 0; at < size; at += piece) {
        parser.feed(std::span(text).subspan(at, std::min(piece, size - at)));
        while (parser.next()) {
        }
    }

    eyelink_modes(text);
    eyelink_validation(text);
    eyelink_drift(text);
    if (size < 2)
        return 0;
    test::KeptItems kept;
    EyelinkDecoder decoder(static_cast<EyelinkEyes>(data[0] % 3), data[1] * 10.0);
    for (std::size_t at = 2; at < size; at += 1 + data[at] % 128) {
        decoder.take(EyelinkItem::lost_data, {}, kept);
        decoder.take(static_cast<EyelinkItem>(data[0] | data[1] << 8), bytes.subspan(at), kept);
    }
    return 0;
}
