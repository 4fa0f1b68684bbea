#include "engine/bullet/other_bullet.hpp"

#include <dlfcn.h>
#include <link.h>

#include <array>
#include <cstring>

#include "LinearMath/btScalar.h"

namespace cullet::bullet {
namespace {

// Numbers that Bullet's libraries define and read: 4 bytes each in single precision, 8 in double. One a library.
constexpr std::array<const char*, 4> kNumbers{"gDeactivationTime", "gContactBreakingThreshold", "gDbvtMargin",
                                              "planetestepsilon"};

/// What the loader has of one library.
struct Loaded {
    ElfW(Addr) base = 0;
    const ElfW(Sym) * symbols = nullptr;
    const char* names = nullptr;
    const ElfW(Rela) * relocations = nullptr;
    size_t count = 0;

    // The loader writes addresses in place, but not in libraries that it cannot write to.
    template <class T>
    const T* at(ElfW(Addr) address) const {
        return reinterpret_cast<const T*>(address < base ? base + address : address);
    }
    explicit Loaded(const dl_phdr_info& info) : base(info.dlpi_addr) {
        for (int p = 0; p < info.dlpi_phnum; ++p) {
            if (info.dlpi_phdr[p].p_type != PT_DYNAMIC) continue;
            const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(base + info.dlpi_phdr[p].p_vaddr);
            for (; entry->d_tag != DT_NULL; ++entry) {
                if (entry->d_tag == DT_SYMTAB) symbols = at<ElfW(Sym)>(entry->d_un.d_ptr);
                if (entry->d_tag == DT_STRTAB) names = at<char>(entry->d_un.d_ptr);
                if (entry->d_tag == DT_RELA) relocations = at<ElfW(Rela)>(entry->d_un.d_ptr);
                if (entry->d_tag == DT_RELASZ) count = entry->d_un.d_val / sizeof(ElfW(Rela));
            }
        }
    }
};

bool is_number(const char* name) {
    for (const char* number : kNumbers)
        if (std::strcmp(name, number) == 0) return true;
    return false;
}

const char* or_program(const char* name) {
    return name && *name ? name : "the program";
}

/// Bytes of the number that stands there, and who defines it.
size_t size_at(const void* place, const char*& definer) {
    Dl_info info;
    const ElfW(Sym)* symbol = nullptr;
    void* found = nullptr;
    if (!dladdr1(place, &info, &found, RTLD_DL_SYMENT)) return 0;
    symbol = static_cast<const ElfW(Sym)*>(found);
    definer = or_program(info.dli_fname);
    return symbol && info.dli_saddr == place ? symbol->st_size : 0;
}

#ifdef __x86_64__
constexpr unsigned kToSymbol = R_X86_64_GLOB_DAT;
#else
constexpr unsigned kToSymbol = 0;  // not looked at
#endif

// A library that defines such a number looks for it by its name. Where the one that it has got is of another size,
// another build answers for it, in functions as in numbers.
int look_at(dl_phdr_info* info, size_t, void* sentence) {
    const Loaded loaded(*info);
    if (!loaded.symbols || !loaded.names || !loaded.relocations) return 0;
    for (size_t r = 0; r < loaded.count; ++r) {
        const ElfW(Rela)& relocation = loaded.relocations[r];
        if (ELF64_R_TYPE(relocation.r_info) != kToSymbol) continue;
        const ElfW(Sym)& own = loaded.symbols[ELF64_R_SYM(relocation.r_info)];
        const char* const name = loaded.names + own.st_name;
        if (own.st_shndx == SHN_UNDEF || !is_number(name)) continue;
        const char* definer = "";
        const size_t size = size_at(*reinterpret_cast<void* const*>(loaded.base + relocation.r_offset), definer);
        if (size == 0 || size == own.st_size) continue;
        *static_cast<std::string*>(sentence) =
            std::string("Two builds of Bullet in this program take each other's names: ") +
            or_program(info->dlpi_name) + " has numbers of " + std::to_string(own.st_size) +
            " bytes and is given those of " + definer + ", of " + std::to_string(size) +
            ". cullet needs Bullet in single precision. Link that alone, hide your own (static, " +
            "with hidden visibility), or load it with RTLD_LOCAL | RTLD_DEEPBIND.";
        return 1;
    }
    return 0;
}

}  // namespace

std::string other_bullet() {
    std::string sentence;
    dl_iterate_phdr(look_at, &sentence);
    // None that is shared but one of double precision, linked in place of ours: it has nobody to differ from.
    const char* definer = "";
    const void* const first = dlsym(RTLD_DEFAULT, kNumbers[0]);
    const size_t size = sentence.empty() && first ? size_at(first, definer) : 0;
    if (size > 0 && size != sizeof(btScalar))
        sentence = std::string("Bullet's names are those of ") + definer + ", whose numbers have " +
                   std::to_string(size) + " bytes; cullet needs Bullet in single precision. Link that, and hide the " +
                   "other (static, with hidden visibility).";
    return sentence;
}

}  // namespace cullet::bullet
