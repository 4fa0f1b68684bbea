#include "sample_game/reproduce/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sample_game/html_text.hpp"
#include "sample_game/notes.hpp"

namespace cullet::reproduce {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #23211e; --soft: #6d675f; --paper: #faf8f4; --card: #ffffff; --line: #e2ddd4;
        --met: #2f7d4f; --short: #b3541e; --shown: #3a6ea5; --none: #8a857c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e9e5dd; --soft: #a49d92; --paper: #1b1a18; --card: #242220;
        --line: #3a3733; --met: #6fc08f; --short: #e3935f; --shown: #86b4e6; --none: #9a948a; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 2.5rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .4rem; letter-spacing: -.01em; }
.facts { color: var(--soft); margin: 0 0 1rem; }
.counts span { display: inline-block; margin-right: 1.1rem; font-weight: 600; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 10px; margin: 1.4rem 0; padding: 1.3rem 1.5rem; }
header { display: flex; gap: 1rem; align-items: baseline; justify-content: space-between; flex-wrap: wrap; }
h2 { font-size: 1.2rem; margin: 0; }
.where { color: var(--soft); font-size: .9rem; }
.verdict { font-weight: 600; font-size: .85rem; padding: .15rem .7rem; border-radius: 99px; border: 1.5px solid currentColor; white-space: nowrap; }
.met { color: var(--met); } .short { color: var(--short); } .shown { color: var(--shown); } .none { color: var(--none); }
.says { display: grid; grid-template-columns: 1fr 1fr; gap: 1.6rem; margin: .9rem 0 .4rem; }
@media (max-width: 760px) { .says { grid-template-columns: 1fr; } }
.says h3 { font-size: .78rem; text-transform: uppercase; letter-spacing: .06em; color: var(--soft); margin: 0 0 .2rem; }
.says p { margin: 0; }
ul.numbers { list-style: none; display: flex; flex-wrap: wrap; gap: .5rem 1.8rem; padding: 0; margin: .9rem 0 .2rem; }
ul.numbers b { font-size: 1.15rem; font-variant-numeric: tabular-nums; }
ul.numbers small { color: var(--soft); display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; margin: .9rem 0 .3rem; font-variant-numeric: tabular-nums; min-width: 100%; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; }
th, td { text-align: right; padding: .28rem .7rem; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; white-space: normal; vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); gap: 1rem; margin-top: 1rem; }
figure { margin: 0; } figure img { width: 100%; display: block; border-radius: 6px; }
figcaption { font-size: .85rem; color: var(--soft); margin-top: .3rem; }
)";

constexpr size_t kMostNumbersShown = 8;  // more stand in a table

const char* style_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Met:
            return "met";
        case Verdict::FallsShort:
            return "short";
        case Verdict::Shown:
            return "shown";
        case Verdict::NotMeasured:
            break;
    }
    return "none";
}

/// Four digits that count, whole numbers whole.
std::string shown(double value) {
    if (std::floor(value) == value && std::fabs(value) < 1e9) return fmt::format("{:.0f}", value);
    return fmt::format("{:.3g}", value);
}

std::string numbers_of(const Claim& claim) {
    if (claim.numbers.empty() || (claim.numbers.size() > kMostNumbersShown && !claim.tables.empty())) return "";
    std::string html = "<ul class=\"numbers\">";
    for (const Number& n : claim.numbers) {
        html += fmt::format("<li><b>{}</b> {}<small>{}", shown(n.ours), escaped(n.unit), escaped(n.name));
        if (n.paper) html += fmt::format("; paper {}", shown(*n.paper));
        html += "</small></li>";
    }
    return html + "</ul>\n";
}

std::string table_of(const Table& table) {
    std::string html = fmt::format("<div class=\"wide\"><table><caption>{}</caption>\n", escaped(table.title));
    for (size_t r = 0; r < table.rows.size(); ++r) {
        html += "<tr>";
        for (const std::string& cell : table.rows[r])
            html += r == 0 ? "<th>" + escaped(cell) + "</th>" : "<td>" + escaped(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string section_of(const Claim& claim) {
    std::string html = fmt::format(
        "<section id=\"{}\"><header><div><h2>{}</h2><span class=\"where\">{}</span></div><span class=\"verdict {}\">{}"
        "</span></header>\n<div class=\"says\"><div><h3>The "
        "paper</h3><p>{}</p></div><div><h3>cullet</h3><p>{}</p></div>"
        "</div>\n",
        claim.id, escaped(claim.title), escaped(claim.where), style_of(claim.verdict), name_of(claim.verdict),
        escaped(claim.paper), escaped(claim.ours));
    html += numbers_of(claim);
    for (const Table& table : claim.tables) html += table_of(table);
    if (!claim.pictures.empty()) {
        html += "<div class=\"pictures\">\n";
        for (const PictureFile& picture : claim.pictures)
            html += fmt::format(
                "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=\"lazy\"></a><figcaption>{1}</figcaption>"
                "</figure>\n",
                picture.file, escaped(picture.caption));
        html += "</div>\n";
    }
    return html + "</section>\n";
}

size_t count_of(std::span<const Claim> claims, Verdict verdict) {
    size_t count = 0;
    for (const Claim& claim : claims) count += claim.verdict == verdict;
    return count;
}

}  // namespace

std::string to_page(std::span<const Claim> claims, const PageFacts& facts) {
    std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>{0}</title><style>{1}</style></head>\n<body><main>"
        "<h1>{0}</h1>\n<p class=\"facts\">{2}, {3} threads; {4:.0f} s for the whole page.{5} {6}</p>\n<p "
        "class=\"counts\">",
        escaped(facts.title), kStyle, escaped(facts.machine), facts.threads, facts.seconds,
        facts.is_reduced ? " A reduced run: smaller meshes, fewer repeats, nothing of it is to be quoted." : "",
        escaped(facts.paper_machine));
    for (const Verdict verdict : {Verdict::Met, Verdict::FallsShort, Verdict::Shown, Verdict::NotMeasured})
        html += fmt::format("<span class=\"{}\">{} {}</span>", style_of(verdict), count_of(claims, verdict),
                            name_of(verdict));
    html += "</p>\n";
    for (const std::string& note : counted_notes(facts.notes))
        html += fmt::format("<p class=\"facts\">{}</p>\n", escaped(note));
    for (const Claim& claim : claims) html += section_of(claim);
    return html + "</main></body></html>\n";
}

std::string to_json(std::span<const Claim> claims, const PageFacts& facts) {
    nlohmann::ordered_json json;
    json["title"] = facts.title;
    json["machine"] = facts.machine;
    json["threads"] = facts.threads;
    json["reduced"] = facts.is_reduced;
    json["seconds"] = facts.seconds;
    json["notes"] = counted_notes(facts.notes);
    for (const Claim& claim : claims) {
        nlohmann::ordered_json& row = json["claims"].emplace_back();
        row["id"] = claim.id;
        row["where"] = claim.where;
        row["title"] = claim.title;
        row["paper"] = claim.paper;
        row["ours"] = claim.ours;
        row["verdict"] = name_of(claim.verdict);
        row["seconds"] = claim.seconds;
        row["numbers"] = nlohmann::ordered_json::array();
        for (const Number& n : claim.numbers) {
            nlohmann::ordered_json& number = row["numbers"].emplace_back();
            number = {{"name", n.name}, {"unit", n.unit}, {"ours", n.ours}};
            if (n.paper) number["paper"] = *n.paper;
        }
        row["tables"] = nlohmann::ordered_json::array();
        for (const Table& table : claim.tables) row["tables"].push_back({{"title", table.title}, {"rows", table.rows}});
        row["pictures"] = nlohmann::ordered_json::array();
        for (const PictureFile& picture : claim.pictures)
            row["pictures"].push_back({{"file", picture.file}, {"caption", picture.caption}});
    }
    return json.dump(2) + "\n";
}

}  // namespace cullet::reproduce
