"""What the pages need beyond Markdown: citations, the page of references, files that pages link to, diagrams."""

import html
import re
import shutil
import subprocess
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
KEY = r"[A-Z][A-Za-z]+(?:18|19|20)\d\d[a-z]?"
LATEX = {r"{\'e}": "é", r"{\'c}": "ć", r"{\'a}": "á", r"{\~n}": "ñ", r'{\"a}': "ä", r"\&": "&", "``": "“", "''": "”",
         "--": "–"}


def entries():
    """Key -> fields of docs/references.bib, in its order."""
    text = (REPOSITORY / "docs/references.bib").read_text()
    for kind, key, body in re.findall(r"^@(\w+)\{(\w+),\n(.*?)^\}", text, re.M | re.S):
        fields = dict(re.findall(r"^\s*(\w+)\s*=\s*\{(.*)\},?$", body, re.M))
        for name, value in fields.items():
            for latex, plain in LATEX.items():
                value = value.replace(latex, plain)
            fields[name] = re.sub(r"[{}]", "", value) if name != "doi" else value
        yield key, {"kind": kind, **fields}


def names(authors):
    people = [" ".join(reversed(a.split(", "))) for a in authors.split(" and ")]
    return people[0] if len(people) == 1 else ", ".join(people[:-1]) + " and " + people[-1]


def reference(entry):
    venue = next((entry[f] for f in ("journal", "booktitle", "school", "publisher") if f in entry), "")
    place = f"*{venue}*" + (f" {entry['volume']}" if "volume" in entry else "")
    place += f"({entry['number']})" if "number" in entry else ""
    place += f", {entry['pages']}" if "pages" in entry else ""
    edition = f", edition {entry['edition']}" if "edition" in entry else ""
    text = f"{names(entry['author'])}. **{entry['title']}**{edition}. {place}, {entry['year']}."
    if "doi" in entry:
        text += f" [doi:{entry['doi']}](https://doi.org/{entry['doi']})"
    return text + (f" {entry['note']}." if "note" in entry else "")


def on_config(config):
    lines = ["# References", "", "As in `docs/references.bib`. Code and pages cite them as `[Key]` or `[Key, place]`.", ""]
    for key, entry in entries():
        lines += [f"**{key}** {{ #{key} }}", "", f":   {reference(entry)}", ""]
    (Path(config["docs_dir"]) / "docs/references.md").write_text("\n".join(lines))
    config["markdown_extensions"].append("def_list")
    return config


def on_page_markdown(markdown, page, **_):
    if page.file.src_path == "README.md":
        page.meta["hide"] = ["navigation"]
    depth = "../" * page.file.src_path.count("/")
    if page.file.src_path == "docs/references.md":
        return re.sub(r"^\*\*(\w+)\*\* \{ #(\w+) \}$", r'<strong id="\2">\1</strong>', markdown, flags=re.M)

    def cited(match):
        inside = re.sub(rf"\b({KEY})\b", rf'<a href="{depth}docs/references.html#\1">\1</a>', match[1])
        return f'<span class="citation">[{inside}]</span>'

    return re.sub(rf"\[({KEY}[^\]\n]*)\](?!\()", cited, markdown)


def on_page_content(content, **_):
    """Long code in a table breaks after slashes and underscores, and shows no escaped bars."""

    def cell(match):
        return match[0] if len(match[0]) < 24 else re.sub(r"([/_])(?=\w)", r"\1<wbr>", match[0])

    return re.sub(r"(?<=<td><code>)[^<]*(?=</code></td>)", cell, content.replace(r"\|", "|"))


def on_files(files, config):
    """A page may link to any file of the repository: it comes along."""
    from mkdocs.structure.files import File

    known = {f.src_path for f in files}
    for page in list(files.documentation_pages()):
        folder = (Path(config["docs_dir"]) / page.src_path).parent
        for target in re.findall(r"\]\(([^)#: ]+)", Path(page.abs_src_path).read_text()):
            path = (folder / target).resolve()
            name = path.relative_to(Path(config["docs_dir"]).resolve()).as_posix()
            source = REPOSITORY / name
            if name in known or not source.is_file():
                continue
            path.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, path)
            files.append(File(name, config["docs_dir"], config["site_dir"], config["use_directory_urls"]))
            known.add(name)
    return files


def drawn(source, language, css_class, options, md, **_):
    """A Mermaid flowchart from left to right, of nodes and arrows only, drawn by Graphviz."""
    nodes = dict(re.findall(r"(\w+)\[([^\]]+)\]", source))
    arrows = re.findall(r"(\w+)(?:\[[^\]]+\])? --> (\w+)", source)
    style = 'fontname="Roboto" fontsize=15 margin="0.12,0.06"'
    graph = [f"digraph {{ rankdir=LR bgcolor=transparent nodesep=0.25 ranksep=0.28 node [shape=box style=rounded {style}]"]
    graph += [f'{name} [label="{label}"]' for name, label in nodes.items()]
    graph += [f"{a} -> {b} [arrowsize=0.7]" for a, b in arrows] + ["}"]
    svg = subprocess.run(["dot", "-Tsvg"], input="\n".join(graph), capture_output=True, text=True, check=True).stdout
    return f'<div class="{html.escape(css_class)}">{svg[svg.index("<svg"):]}</div>'
