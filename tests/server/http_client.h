// A small HTTP client over plain sockets, so that tests see every byte that the service sends, and can send
// it what no proper client would.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coppice::test {

struct Answer {
    int status = 0;                                   // 0: no answer came
    std::multimap<std::string, std::string> headers;  // names in lower case
    std::string body;

    std::string header(const std::string& name) const;  // empty when there is none

    friend std::ostream& operator<<(std::ostream& out, const Answer& answer) {
        return out << answer.status << " " << answer.body.substr(0, 1000);
    }
};

using HeaderList = std::vector<std::pair<std::string, std::string>>;

class Connection {
  public:
    explicit Connection(int port);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void send_bytes(std::string_view bytes);
    void finish_sending();                   // what was sent is all there will be
    Answer receive(bool head_only = false);  // one answer; interim ones (1xx) are skipped
    std::string receive_until_closed();      // all that comes

    Answer request(const std::string& method, const std::string& target, const HeaderList& headers = {},
                   std::string_view body = {});

  private:
    bool receive_more();

    int socket_ = -1;
    std::string buffer_;
};

// On a connection of its own.
Answer request(int port, const std::string& method, const std::string& target, const HeaderList& headers = {},
               std::string_view body = {});

struct FormPart {
    std::string name;
    std::string content;
    std::string file_name = {};
    std::string media_type = {};
};

// {Content-Type, body}
std::pair<std::string, std::string> multipart(const std::vector<FormPart>& parts);

}  // namespace coppice::test
