// The values of a PLY body, one after the other, whatever their encoding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/format/line_reader.h"
#include "core/format/ply/ply_header.h"

namespace coppice {

[[noreturn]] inline void fail_at_end(std::string where) {
    fail(ErrorCode::asset_malformed, std::move(where), "the PLY ends before all of its elements were there");
}

// Words of text, line ends are blanks.
class PlyText {
  public:
    PlyText(ByteView bytes, const PlyHeader& header)
        : lines_(as_text(bytes).substr(header.bytes)), header_(header) {
        bytes_ = bytes.size() - header.bytes;
    }

    double next(PlyType) {
        require_line();
        return line_.number("a PLY value");
    }
    // How many more values there can be at most.
    bool can_hold(uint64_t rows, const PlyElement& element) const {
        return element.properties.empty() || rows <= (bytes_ + 1) / (2 * element.properties.size());
    }
    bool can_hold_items(uint64_t items, PlyType) const { return items <= bytes_; }
    std::string where() const {
        return fmt::format("line {}", line_.number() == 0 ? header_.lines : line_.number());
    }

  private:
    void require_line() {
        while (line_.done()) {
            const bool more = lines_.next(line_);
            if (!more) fail_at_end(where());
            line_.count_from(header_.lines);
        }
    }

    LineReader lines_;
    Line line_ = Line("", 0);
    const PlyHeader& header_;
    uint64_t bytes_ = 0;
};

template <std::endian order>
class PlyBinary {
  public:
    PlyBinary(ByteView bytes, const PlyHeader& header) : bytes_(bytes), at_(header.bytes) {}

    double next(PlyType type) {
        const size_t size = size_of(type);
        if (size > bytes_.size() - at_) fail_at_end(where());
        const std::byte* value = bytes_.data() + at_;
        at_ += size;
        switch (type) {
            case PlyType::int8:
                return load<int8_t>(value);
            case PlyType::uint8:
                return load<uint8_t>(value);
            case PlyType::int16:
                return load<int16_t>(value);
            case PlyType::uint16:
                return load<uint16_t>(value);
            case PlyType::int32:
                return load<int32_t>(value);
            case PlyType::uint32:
                return load<uint32_t>(value);
            case PlyType::float32:
                return load<float>(value);
            case PlyType::float64:
                return load<double>(value);
        }
        return 0;
    }
    bool can_hold(uint64_t rows, const PlyElement& element) const {
        const size_t row = element.smallest_row_bytes();
        return row == 0 || rows <= (bytes_.size() - at_) / row;
    }
    bool can_hold_items(uint64_t items, PlyType type) const {
        return items <= (bytes_.size() - at_) / size_of(type);
    }
    std::string where() const { return fmt::format("byte {}", at_); }

  private:
    template <typename T>
    static T load(const std::byte* from) {
        std::array<std::byte, sizeof(T)> raw;
        std::memcpy(raw.data(), from, sizeof(T));
        if constexpr (order != std::endian::native) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    ByteView bytes_;
    size_t at_;
};

}  // namespace coppice
