// Things to take along: files and the clipboard.

export function save(name, parts, type) {
    const url = URL.createObjectURL(new Blob(parts, {type}));
    const link = document.createElement('a');
    link.href = url;
    link.download = name;
    link.click();
    // The download has its own hold on the bytes once it has begun.
    setTimeout(() => URL.revokeObjectURL(url), 10000);
}

// The clipboard is there in secure contexts only, which a page from another machine is not.
export async function copy(field) {
    try {
        await navigator.clipboard.writeText(field.value);
        return true;
    } catch {
        field.select();
        return document.execCommand('copy');
    }
}
