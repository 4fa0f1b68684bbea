#include "sample_game/reproduce/command.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "sample_game/report.hpp"
#include "sample_game/reproduce/claims.hpp"
#include "sample_game/reproduce/metal/metal_claims.hpp"
#include "sample_game/reproduce/page.hpp"

namespace cullet::reproduce {
namespace {

int refuse(const std::string& sentence, int code) {
    fmt::print(stderr, "{}\n", sentence);
    return code;
}

std::string data_folder(const std::string& given) {
    if (!given.empty()) return given;
    const char* folder = std::getenv("CULLET_TEST_DATA");
    return folder ? folder : "../shared/data";
}

/// A published work: a line more is a page more.
struct Paper {
    const char *model, *title, *machine;
    std::span<const ClaimEntry> (*claims)();
};
constexpr Paper kPapers[] = {{"thick_shell", "Thick shells: the paper's claims and cullet's",
                              "Published numbers are of a Pentium 4 with 3 GHz.", thick_shell_claims},
                             {"metal_shell", "Metal shells: the paper's claims and cullet's",
                              "The paper does not name its machine.", metal_shell_claims}};

const Paper* paper_of(const std::string& model) {
    for (const Paper& paper : kPapers)
        if (model == paper.model) return &paper;
    return nullptr;
}

bool is_known(const Paper& paper, const std::string& id) {
    for (const ClaimEntry& entry : paper.claims())
        if (id == entry.id) return true;
    return false;
}

std::string known_claims(const Paper& paper) {
    std::string names;
    for (const ClaimEntry& entry : paper.claims()) names += (names.empty() ? "" : ", ") + std::string(entry.id);
    return names;
}

Result<std::vector<Claim>> make_claims(Bench& bench, const Paper& paper, const std::string& only) {
    std::vector<Claim> claims;
    for (const ClaimEntry& entry : paper.claims()) {
        if (!only.empty() && only != entry.id) continue;
        const double start = seconds_now();
        Result<Claim> claim = entry.make(bench);
        if (!claim.ok()) return Error{fmt::format("{}: {}", entry.id, claim.error())};
        claim->seconds = seconds_now() - start;
        fmt::print("{:<22} {:<14} {:5.1f} s  {}\n", claim->id, name_of(claim->verdict), claim->seconds, claim->title);
        std::fflush(stdout);
        claims.push_back(std::move(claim).value());
    }
    return claims;
}

}  // namespace

std::string known_models() {
    std::string names;
    for (const Paper& paper : kPapers) names += (names.empty() ? "" : ", ") + std::string(paper.model);
    return names;
}

int run(const CommandOptions& options) {
    const Paper* const paper = paper_of(options.model);
    if (!paper) return refuse(fmt::format("reproduce {}: not known; there are {}.", options.model, known_models()), 2);
    if (!options.only.empty() && !is_known(*paper, options.only))
        return refuse(
            fmt::format("--only {}: there is no such claim; there are {}.", options.only, known_claims(*paper)), 2);
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error)
        return refuse(fmt::format("--out {}: {}; choose a folder that can be made.", options.out, error.message()), 2);
    Bench bench({options.out, data_folder(options.data), options.threads, options.is_reduced});
    const double start = seconds_now();
    const Result<std::vector<Claim>> claims = make_claims(bench, *paper, options.only);
    if (!claims.ok()) return refuse("reproduce: " + claims.error(), 1);
    const PageFacts facts{paper->title,       paper->machine,        describe_machine(), bench.threads(),
                          options.is_reduced, seconds_now() - start, bench.notes()};
    for (const auto& [text, name] : {std::pair(to_page(claims.value(), facts), "report.html"),
                                     std::pair(to_json(claims.value(), facts), "report.json")})
        if (auto written = write_text(text, options.out + "/" + name); !written.ok()) return refuse(written.error(), 1);
    for (const std::string& note : bench.notes()) fmt::print("note  {}\n", note);
    fmt::print("{}/report.html  {} claims in {:.0f} s\n", options.out, claims->size(), facts.seconds);
    return 0;
}

}  // namespace cullet::reproduce
