#include "tests/server/http_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace coppice::test {
namespace {

constexpr int patience_ms = 20'000;  // a service that hangs fails the test instead of stopping it

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

}  // namespace

std::string Answer::header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? std::string() : found->second;
}

Connection::Connection(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        throw std::runtime_error("cannot connect to port " + std::to_string(port));
    }
    const int yes = 1;  // a body does not wait until its head was acknowledged
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

Connection::~Connection() {
    ::close(socket_);
}

void Connection::send_bytes(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;  // the service has closed; what it said is still to be read
        bytes.remove_prefix(static_cast<size_t>(sent));
    }
}

void Connection::finish_sending() {
    ::shutdown(socket_, SHUT_WR);
}

bool Connection::receive_more() {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, patience_ms) <= 0) throw std::runtime_error("the service does not answer");
    std::array<char, 65536> bytes{};
    const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (got <= 0) return false;
    buffer_.append(bytes.data(), static_cast<size_t>(got));
    return true;
}

Answer Connection::receive(bool head_only) {
    for (;;) {
        size_t end = 0;
        while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
            if (!receive_more()) return {};
        }
        Answer answer;
        answer.status = std::stoi(buffer_.substr(9, 3));
        for (size_t line = buffer_.find("\r\n") + 2; line < end;) {
            const size_t line_end = buffer_.find("\r\n", line);
            const size_t colon = buffer_.find(": ", line);
            answer.headers.emplace(lower(buffer_.substr(line, colon - line)),
                                   buffer_.substr(colon + 2, line_end - colon - 2));
            line = line_end + 2;
        }
        buffer_.erase(0, end + 4);
        if (answer.status < 200) continue;
        const std::string length = answer.header("content-length");
        const size_t bytes = head_only || length.empty() ? 0 : std::stoul(length);
        while (buffer_.size() < bytes && receive_more()) {
        }
        answer.body = buffer_.substr(0, bytes);
        buffer_.erase(0, bytes);
        return answer;
    }
}

std::string Connection::receive_until_closed() {
    while (receive_more()) {
    }
    return std::exchange(buffer_, {});
}

Answer Connection::request(const std::string& method, const std::string& target, const HeaderList& headers,
                           std::string_view body) {
    std::string head = method + " " + target + " HTTP/1.1\r\nHost: test\r\n";
    for (const auto& [name, value] : headers) head += name + ": " + value + "\r\n";
    if (!body.empty() || method == "POST") head += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    send_bytes(head + "\r\n");
    send_bytes(body);
    return receive(method == "HEAD");
}

Answer request(int port, const std::string& method, const std::string& target, const HeaderList& headers,
               std::string_view body) {
    return Connection(port).request(method, target, headers, body);
}

std::pair<std::string, std::string> multipart(const std::vector<FormPart>& parts) {
    std::string body;
    for (const FormPart& part : parts) {
        body += "--XyZ\r\nContent-Disposition: form-data; name=\"" + part.name + "\"";
        if (!part.file_name.empty()) body += "; filename=\"" + part.file_name + "\"";
        body += "\r\n";
        if (!part.media_type.empty()) body += "Content-Type: " + part.media_type + "\r\n";
        body += "\r\n" + part.content + "\r\n";
    }
    return {"multipart/form-data; boundary=XyZ", body + "--XyZ--\r\n"};
}

}  // namespace coppice::test
