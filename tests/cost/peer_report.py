"""How the comparisons with other programs tell what was judged."""


def print_verdicts(lines):
    print()
    for sentence, met in lines:
        print(f"- {'not judged' if met is None else 'met' if met else 'MISSED'}: {sentence}")
