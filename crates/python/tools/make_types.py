"""Writes python/stickslip/types.py, the types of a scenario's dict, from the JSON Schema: python tools/make_types.py"""

import json
import keyword
import textwrap
from pathlib import Path

HERE = Path(__file__).parent
SCHEMA = json.loads((HERE / "../../../schema/scenario-1.json").read_text(encoding="utf-8"))
HEAD = '''"""Types of a scenario's dict, made from its JSON Schema by tools/make_types.py: editors complete keys and check values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Protocol, TypedDict, Union

if TYPE_CHECKING:
    from typing_extensions import NotRequired


class WithUnits(Protocol):
    """A quantity with units, such as those of pint."""

    def to_base_units(self) -> Any: ...


Quantity = Union[float, str, WithUnits]
"""A number in the SI unit, a text with a unit such as "0.5 mm", or a quantity of pint."""
'''


# Kinds that the schema writes where they stand, such as {"sine": …}: classes by the names of their keys.
KINDS: dict[str, str] = {}


def name_of(reference: str) -> str:
    return reference.rsplit("/", 1)[1].removesuffix("Form")


def of(schema: dict) -> str:
    """The type of a value."""
    if "$ref" in schema:
        return f'"{name_of(schema["$ref"])}"'
    if "const" in schema or "enum" in schema:
        return f"Literal[{', '.join(json.dumps(one) for one in schema.get('enum', [schema.get('const')]))}]"
    for key in ("oneOf", "anyOf"):
        if key in schema:
            return union([of(one) for one in schema[key]])
    kind = schema.get("type")
    if isinstance(kind, list):
        return union([of({**schema, "type": one}) for one in kind])
    if kind == "array":
        items = schema.get("items", schema.get("prefixItems", [{}]))
        return f"list[{union([of(one) for one in items]) if isinstance(items, list) else of(items)}]"
    if kind == "object":
        if "properties" in schema:
            name = "".join(word.title() for key in schema["properties"] for word in key.split("_")) + "Kind"
            KINDS[name] = definition(name, schema)
            return f'"{name}"'
        inner = schema.get("additionalProperties")
        return f"dict[str, {of(inner)}]" if isinstance(inner, dict) else "dict[str, Any]"
    return {"number": "float", "integer": "int", "string": "str", "boolean": "bool", "null": "None"}.get(kind, "Any")


def union(types: list[str]) -> str:
    types = list(dict.fromkeys(types))
    if set(types) >= {"float", "str"}:
        types = ["Quantity", *(one for one in types if one not in ("float", "str"))]
    return types[0] if len(types) == 1 else f"Union[{', '.join(types)}]"


def text(schema: dict, indent: str) -> str:
    words = schema.get("description", "").replace("\\", "\\\\").replace('"""', "'''").replace("\n", " ")
    if not words:
        return ""
    if words.endswith('"'):
        words += " "
    lines = textwrap.wrap(words, 110 - len(indent), break_long_words=False)
    return indent + '"""' + ("\n" + indent).join(lines) + '"""\n'


def definition(name: str, schema: dict) -> str:
    if schema.get("type") != "object" or "properties" not in schema:
        return f"\n{name} = {of(schema)}\n{text(schema, '')}"
    fields = schema["properties"]
    required = schema.get("required", [])

    def field(key: str, value: dict) -> str:
        kind = of(value)
        return kind if key in required else f"NotRequired[{kind}]"

    odd = {key for key in fields if keyword.iskeyword(key) or not key.isidentifier()}
    base = "TypedDict"
    before = ""
    if odd:
        base = f"_{name}"
        body = ", ".join(f'"{key}": {of(fields[key])}' for key in sorted(odd))
        before = f'\n{base} = TypedDict("{base}", {{{body}}}, total=False)\n'
        fields = {key: value for key, value in fields.items() if key not in odd}
    lines = "".join(f"    {key}: {field(key, value)}\n{text(value, '    ')}" for key, value in fields.items())
    return f"{before}\n\nclass {name}({base}):\n{text(schema, '    ')}\n{lines}"


def main() -> str:
    definitions = {name.removesuffix("Form"): one for name, one in SCHEMA["$defs"].items()}
    body = "".join(definition(name, one) for name, one in definitions.items() if name != "Quantity")
    root = definition("ScenarioDict", SCHEMA)
    return HEAD + "".join(KINDS.values()) + body + root


if __name__ == "__main__":
    (HERE / "../python/stickslip/types.py").write_text(main(), encoding="utf-8")
