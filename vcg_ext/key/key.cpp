#include "key.h"

#include "../error.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sodium.h>

namespace vcg_ext {

namespace {

// The salt is part of the format: with another one, no mark made so far could be read.
constexpr char salt[] = "filter_watermark";
static_assert(sizeof salt - 1 == crypto_pwhash_SALTBYTES);
constexpr unsigned long long passes = 2;
constexpr std::size_t memory = 64u << 20;

/// A copy of secret bytes, wiped when it ends. On the heap, so that moving it leaves nothing behind.
struct Secret {
    explicit Secret(std::string_view secret) : bytes(secret.begin(), secret.end()) {}
    Secret(Secret&&) = default;
    ~Secret() { sodium_memzero(bytes.data(), bytes.size()); }

    std::vector<char> bytes;
};

void derive(const Secret& secret, std::array<unsigned char, 32>& master)
{
    if (crypto_pwhash(master.data(), master.size(), secret.bytes.data(), secret.bytes.size(),
                      reinterpret_cast<const unsigned char*>(salt), passes, memory, crypto_pwhash_ALG_ARGON2ID13) != 0)
        throw Error(
            "Deriving the key needs 64 MiB of memory, which could not be had. Close other programs and try again.");
}

std::string read_file(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw Error("The key file '" + path + "' cannot be read. Check its path and permissions.");
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.empty())
        throw Error("The key file '" + path + "' is empty. Write the secret into it, or name another.");
    return bytes;
}

std::string read_environment(const std::string& name)
{
    const char* value = std::getenv(name.c_str());
    if (!value || !*value)
        throw Error("The environment variable '" + name +
                    "', which should hold the key, is not set. Set it and try again.");
    return value;
}

} // namespace

Stream::Stream(const std::array<unsigned char, 32>& subkey) : subkey_(subkey), used_(block_.size()) {}

Stream::~Stream()
{
    sodium_memzero(subkey_.data(), subkey_.size());
    sodium_memzero(block_.data(), block_.size());
}

void Stream::refill()
{
    constexpr unsigned char nonce[crypto_stream_chacha20_NONCEBYTES] = {};
    block_.fill(0);
    crypto_stream_chacha20_xor_ic(block_.data(), block_.data(), block_.size(), nonce, counter_, subkey_.data());
    counter_ += block_.size() / 64; // ChaCha20 counts blocks of 64 bytes
    used_ = 0;
}

std::uint64_t Stream::next()
{
    if (used_ == block_.size())
        refill();
    std::uint64_t value = 0;
    for (int byte = 7; byte >= 0; --byte)
        value = value << 8 | block_[used_ + byte];
    used_ += 8;
    return value;
}

std::uint64_t Stream::below(std::uint64_t n)
{
    const std::uint64_t rest = (UINT64_MAX % n + 1) % n; // 2^64 mod n: so many values too many
    for (;;) {
        const std::uint64_t value = next();
        if (value <= UINT64_MAX - rest)
            return value % n;
    }
}

std::vector<int> Stream::permutation(int n)
{
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (int i = n - 1; i > 0; --i)
        std::swap(order[i], order[below(i + 1)]);
    return order;
}

Key::Master::~Master()
{
    sodium_memzero(bytes.data(), bytes.size());
}

Key::Key(std::string_view secret)
{
    if (secret.empty())
        throw Error("The key is empty. Give a passphrase, file:PATH or env:NAME.");
    if (sodium_init() < 0)
        throw Error("libsodium could not start, so there is no key. Check the system's source of random numbers.");
    master_ = std::async(std::launch::async, [secret = Secret(secret)] {
                  auto master = std::make_unique<Master>();
                  derive(secret, master->bytes);
                  return std::unique_ptr<const Master>(std::move(master));
              }).share();
}

Stream Key::stream(std::string_view purpose) const
{
    const std::array<unsigned char, 32>& master = master_.get()->bytes;
    std::array<unsigned char, 32> subkey;
    crypto_generichash(subkey.data(), subkey.size(), reinterpret_cast<const unsigned char*>(purpose.data()),
                       purpose.size(), master.data(), master.size());
    return Stream(subkey);
}

Key key_from_text(const std::string& text)
{
    std::string secret = text.rfind("file:", 0) == 0  ? read_file(text.substr(5))
                         : text.rfind("env:", 0) == 0 ? read_environment(text.substr(4))
                                                      : text;
    struct Wipe {
        std::string& bytes;
        ~Wipe() { sodium_memzero(bytes.data(), bytes.size()); }
    } wipe{secret};
    return Key(secret);
}

} // namespace vcg_ext
