#include <cstdio>

int main() {
    std::puts("coppice");
    return 0;
}
