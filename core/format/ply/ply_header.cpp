#include "core/format/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/error.h"
#include "core/format/line_reader.h"

namespace coppice {

namespace {

constexpr uint64_t most_rows = 0xffffffff;
constexpr size_t most_elements = 64, most_properties = 256;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

// One past the header, end_header's line end included; the end of the text where there is no such line.
size_t header_end(std::string_view text) {
    const bool only_returns = text.starts_with("ply\r") && !text.starts_with("ply\r\n");
    const char terminator = only_returns ? '\r' : '\n';
    for (size_t line = 0; line < text.size();) {
        const size_t end = std::min(text.find(terminator, line), text.size());
        const size_t word = std::min(text.find_first_not_of(" \t", line), end);
        std::string_view content = text.substr(word, end - word);
        while (!content.empty() &&
               (content.back() == '\r' || content.back() == ' ' || content.back() == '\t')) {
            content.remove_suffix(1);
        }
        if (content == "end_header") return std::min(end + 1, text.size());
        line = end + 1;
    }
    return text.size();
}

class HeaderParser {
  public:
    PlyHeader parse(std::string_view text) {
        LineReader reader(text);
        Line line;
        reader.next(line);
        while (reader.next(line)) statement(line);
        if (!has_format_) line.fail("the PLY header has no format line");
        if (!has_end_) line.fail("the PLY header has no end_header line");
        header_.bytes = text.size();
        header_.lines = line.number();
        return std::move(header_);
    }

  private:
    void statement(Line& line) {
        const std::string_view word = line.word();
        if (word == "comment" || word == "obj_info") return comment(line);
        has_end_ = word == "end_header";
        if (word.empty() || has_end_) return;
        if (word == "format") {
            format(line);
        } else if (!has_format_) {
            line.fail("\"{}\" stands before the format line", word);
        } else if (word == "element") {
            element(line);
        } else if (word == "property") {
            property(line);
        } else {
            line.fail(
                "\"{}\" is no PLY header line; format, comment, obj_info, element, property, end_header are",
                word.substr(0, 40));
        }
        if (!line.done()) line.fail("\"{}\" is too much in the {} line", line.rest().substr(0, 40), word);
    }

    void comment(Line& line) {
        if (line.word() == "TextureFile" && !line.done()) header_.texture_files.emplace_back(line.rest());
    }

    void format(Line& line) {
        const std::string_view name = line.word();
        if (name == "ascii") {
            header_.encoding = PlyEncoding::ascii;
        } else if (name == "binary_little_endian") {
            header_.encoding = PlyEncoding::little_endian;
        } else if (name == "binary_big_endian") {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            line.fail("format \"{}\" is none of ascii, binary_little_endian, binary_big_endian",
                      name.substr(0, 40));
        }
        const std::string_view version = line.word();
        if (version != "1.0") line.fail("PLY version \"{}\" is not read; 1.0 is", version.substr(0, 40));
        has_format_ = true;
    }

    void element(Line& line) {
        const std::string name(line.word());
        for (const PlyElement& earlier : header_.elements) {
            if (earlier.name == name) line.fail("element {} stands there twice", name.substr(0, 40));
        }
        PlyElement& element = header_.elements.emplace_back();
        element.name = name;
        const int64_t count = line.integer("the count of an element");
        if (count < 0 || static_cast<uint64_t>(count) > most_rows) {
            line.fail("element {} has {} rows; 0 to {} are possible", element.name, count, most_rows);
        }
        element.count = static_cast<uint64_t>(count);
        if (header_.elements.size() > most_elements) line.fail("more than {} elements", most_elements);
    }

    void property(Line& line) {
        if (header_.elements.empty()) line.fail("a property stands before any element");
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        PlyProperty& property = properties.emplace_back();
        std::string_view word = line.word();
        if (word == "list") {
            property.list_count = type(line, line.word());
            if (!is_integer(*property.list_count))
                line.fail("the length of a list must have an integer type");
            word = line.word();
        }
        property.type = type(line, word);
        property.name = std::string(line.word());
        if (property.name.empty()) line.fail("a property needs a name");
        if (properties.size() > most_properties) line.fail("more than {} properties", most_properties);
    }

    static PlyType type(const Line& line, std::string_view name) {
        const auto at = std::find_if(type_names.begin(), type_names.end(),
                                     [&](const auto& row) { return row.first == name; });
        if (at == type_names.end()) {
            line.fail("\"{}\" is no PLY type; char, uchar, short, ushort, int, uint, float, double are",
                      name.substr(0, 40));
        }
        return at->second;
    }

    PlyHeader header_;
    bool has_format_ = false, has_end_ = false;
};

}  // namespace

size_t size_of(PlyType type) {
    constexpr std::array<size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<size_t>(type)];
}

bool is_integer(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

double largest(PlyType type) {
    constexpr std::array<double, 8> values = {127, 255, 32767, 65535, 2147483647.0, 4294967295.0, 1, 1};
    return values[static_cast<size_t>(type)];
}

std::optional<size_t> PlyElement::find(std::string_view property) const {
    for (size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == property) return i;
    }
    return std::nullopt;
}

size_t PlyElement::smallest_row_bytes() const {
    size_t bytes = 0;
    for (const PlyProperty& p : properties) bytes += size_of(p.list_count.value_or(p.type));
    return bytes;
}

PlyHeader parse_ply_header(ByteView bytes) {
    const std::string_view text = as_text(bytes);
    return HeaderParser().parse(text.substr(0, header_end(text)));
}

}  // namespace coppice
